#include "kernels/boundaries/walls/walls.hpp"

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/on_device.hpp"
#include "cellgrid/simd/box.hpp"

namespace freshet {
namespace {

void number(const Field<int>& id, int n) {
  launch(
      "walls::number", Range(0, n), KOKKOS_LAMBDA(int k) { id(k) = k; });
}

Box box_of(const std::vector<Polyline>& lines, double beyond) {
  Polyline all;
  for (const Polyline& line : lines) all.insert(all.end(), line.begin(), line.end());
  const Box box = bounds_of(all);
  return {box.xlo - beyond, box.xhi + beyond, box.ylo - beyond, box.yhi + beyond};
}

}  // namespace

template <int D>
Walls<D>::Walls(const std::vector<Polyline>& lines, const WallOptions& options, const Point& inside,
                double support)
    : order_(D, options.spacing, box_of(lines, 8 * options.spacing)), near_(32, "walls::list", false),
      kind_(options.kind),
      // A virtual particle lies twice as far away as its wall point; a neighbour's image may stand right
      // behind the wall.
      reach_(support / kind_.stretch.factor[0]), depth_(2 * options.spacing) {
  const WallGeometry g = lay_walls(D, lines, options, inside);
  points_ = FieldSet(static_cast<int>(g.points.size()));
  const auto add = [&](const char* name, const auto& value) {
    upload(points_.real(name, "m", Carry::sort), g.points.size(),
           [&](size_t k) { return value(g.points[k]); });
  };
  add("x", [](const WallPoint& w) { return w.x[0]; });
  add("pxx", [](const WallPoint& w) { return w.p[0]; });
  add("share", [](const WallPoint& w) { return w.share; });
  if (D == 2) {
    add("y", [](const WallPoint& w) { return w.x[1]; });
    add("pxy", [](const WallPoint& w) { return w.p[1]; });
    add("pyy", [](const WallPoint& w) { return w.p[2]; });
  }
  upload(points_.integer("piece", "1", Carry::sort), g.points.size(),
         [&](size_t k) { return g.points[k].piece; });
  number(points_.integer("id", "1", Carry::sort), points_.size());
  order_.sort(points_);
  // Water alone decides what is near. With tiles of that size (most clusters' reach) water off the walls sees
  // at once that none is.
  constexpr double next_to_nothing = 1e-6, tile = 4;  // x spacing
  const Field<double> h = points_.real("h", "m", Carry::no);
  assign(h, next_to_nothing * options.spacing);
  order_.measure_reach(points_, h, tile / next_to_nothing);
  pieces_ = on_device("walls.pieces", g.pieces);
  bins_ = g.bins;
}

template <int D>
WallView<D> Walls<D>::view() const {
  WallView<D> view;
  view.on = kind_.felt;
  view.mirror = kind_.mirror;
  view.rows = kind_.rows;
  view.stretch = kind_.stretch;
  view.near = near_.view();
  view.piece = points_.integer("piece");
  view.pieces = pieces_;
  view.bins = bins_;
  view.deepest = depth_;
  view.share = points_.real("share");
  view.x.x = points_.real("x");
  view.projector.xx = points_.real("pxx");
  if constexpr (D == 2) {
    view.x.y = points_.real("y");
    view.projector.xy = points_.real("pxy");
    view.projector.yy = points_.real("pyy");
  }
  return view;
}

namespace {

// The largest h [m] of a particle and of the neighbours that reach it: their images stand no nearer than they
// do themselves. Looked for where walls may be within that reach.
template <int D>
struct FeltLength {
  ClusterSet clusters;
  NeighbourView near;
  VecField<double, D> x;
  Field<double> h, felt;
  Rows water, walls;
  double reach;  // x h

  KOKKOS_INLINE_FUNCTION bool walls_in_reach(const Box& b) const {
    return walls.largest_h(b.xlo, b.xhi, b.ylo, b.yhi) > 0 ||
           walls.support < reach * water.largest_h(b.xlo, b.xhi, b.ylo, b.yhi);
  }
  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = clusters(c);
    const Vec<Lane, D> here = me.load(x);
    Lane longest = me.load(h);
    if (walls_in_reach(box_of(here)))
      near.for_each(c, [&](int j) {
        const Vec<Lane, D> d = here - broadcast(at(x, j));
        const Lane theirs = h(j), limit = reach * theirs;
        longest = larger_where(dot(d, d) < limit * limit, longest, theirs);
      });
    me.store(felt, longest);
  }
};

}  // namespace

template <int D>
void Walls<D>::find(const ClusterSet& clusters, const ListRequest<D>& water, const NeighbourView& near) {
  Field<double> h = water.h;
  if (kind_.mirror) {
    if (felt_h_.extent(0) < h.extent(0))
      felt_h_ = Field<double>(Kokkos::ViewAllocateWithoutInitializing("walls.felt_h"), h.extent(0));
    const double reach = reach_ * (1 + water.margin);
    launch("walls::felt_h", balanced(clusters.size()),
           FeltLength<D>{clusters, near, water.x, h, felt_h_, water.source_rows, order_.rows(), reach});
    h = felt_h_;
  }
  near_.build<D>(clusters, {water.x, h, order_.rows(), view().x, points_.real("h"), reach_, water.margin});
}

namespace {

// Whether some lane stands behind the piece's line and nearer to it than a distance whose square is far2
// [m2], by more than rounding; free ends count as wall.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION bool any_behind(const Piece& s, const Vec<Lane, D>& p, double slack,
                                            double far2) {
  const Foot<Lane> f = foot_on(s, p);
  const Vec<Lane, D> from = from_nearest(s, p, f.along);
  return any((f.off < Lane(slack)) & (dot(from, from) < Lane(far2)));
}

// Whether some particle of the cluster may be behind a wall: all lanes at once, since hardly any is.
template <int D>
KOKKOS_INLINE_FUNCTION bool may_be_behind(const WallView<D>& walls, int cluster, const Vec<Lane, D>& here,
                                          double deepest) {
  constexpr double ties = 1e-6;  // and rounding
  int last = -1;
  bool behind = false;
  walls.near.for_each(cluster, [&](int k) {
    const int piece = walls.piece(k);
    if (piece != last && !behind)
      behind = any_behind(walls.pieces(piece), here, ties * deepest, (1 + ties) * deepest * deepest);
    last = piece;
  });
  return behind;
}

// Only the pieces near the position's cluster are looked at.
template <int D>
KOKKOS_INLINE_FUNCTION NearestPiece nearest_of(const WallView<D>& walls, int cluster, const Vec<double, D>& p,
                                               double deepest) {
  int last = -1;
  NearestPiece nearest(deepest);
  walls.near.for_each(cluster, [&](int k) {
    const int here = walls.piece(k);
    if (here != last) nearest.look_at(here, walls.pieces(here), p);
    last = here;
  });
  return nearest;
}

}  // namespace

template <int D>
void Walls<D>::reflect(const ClusterSet& clusters, const VecField<double, D>& x, const VecField<double, D>& v,
                       const VecField<double, D>& v_pred) const {
  constexpr int most_bounces = 3;  // a corner takes two
  const WallView<D> walls = view();
  const double deepest = depth_;
  const ClusterSet sets = clusters;
  launch(
      "walls::reflect", Range(0, clusters.size()), KOKKOS_LAMBDA(int c) {
        if (walls.near.length(c) == 0) return;
        const Lanes me = sets(c);
        if (!may_be_behind<D>(walls, c, me.load(x), deepest)) return;
        for (int i = me.first; i < me.first + me.count; ++i)
          for (int bounce = 0; bounce < most_bounces; ++bounce) {
            const NearestPiece nearest = nearest_of<D>(walls, c, at(x, i), deepest);
            if (nearest.foot.off >= 0) break;
            const Vec<double, D> normal = normal_of<D>(walls.pieces(nearest.piece));
            put(x, i, at(x, i) + (-2 * nearest.foot.off) * normal);
            const VecField<double, D>* const velocities[2] = {&v, &v_pred};  // not copies: those are counted
            for (const auto* velocity : velocities) {
              const double outward = smaller(dot(at(*velocity, i), normal), 0.0);
              put(*velocity, i, at(*velocity, i) + (-2 * outward) * normal);
            }
          }
      });
}

template class Walls<1>;
template class Walls<2>;

}  // namespace freshet
