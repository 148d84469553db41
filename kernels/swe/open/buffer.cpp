#include "kernels/swe/open/buffer.hpp"

#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/open/exterior.hpp"
#include "kernels/water/ids.hpp"

namespace freshet::swe {
namespace {

// In which lanes a particle's kind is that of the owner.
KOKKOS_FORCEINLINE_FUNCTION auto owned_by(int owner, LaneIndex kind) {
  const Lane off = to_real(kind) - Lane(static_cast<double>(owner));
  return off * off < Lane(0.25);
}

// What meets a closed row is reflected, like at a wall.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION void bounce(const Particles<D>& f, int i, double inside,
                                        const Vec<double, D>& inward) {
  put(f.x, i, at(f.x, i) + (-2 * inside) * inward);
  const VecField<double, D>* const velocities[2] = {&f.v, &f.v_pred};  // not copies: those are counted
  for (const auto* v : velocities)
    put(*v, i, at(*v, i) + (-2 * smaller(dot(at(*v, i), inward), 0.0)) * inward);
}

// The particle keeps its area, and with it h.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION void set_depth(const Particles<D>& f, int i, double rho) {
  f.m(i) *= rho / f.rho(i);
  f.kh(i) *= rho / f.rho(i);
  f.rho(i) = rho;
}

}  // namespace

template <int D>
void OpenBuffer<D>::survey(const std::optional<BedTerm<D>>& bed) {
  const auto row = row_;
  const Frame at_line = frame();
  const std::optional<BedTerm<D>> ground = bed;
  launch(
      "open::survey", Range(0, count_),
      KOKKOS_LAMBDA(int r) { row(r).bed = bed_at<D>(ground, at_line.point(at_line.before + r, 0)); });
}

template <int D>
void OpenBuffer<D>::observe(const Rows& rows, const Particles<D>& p, const Field<int>& kind,
                            const std::optional<BedTerm<D>>& bed) {
  const Frame at_line = frame();
  const auto row = row_;
  const std::optional<BedTerm<D>> ground = bed;
  const Particles<D> f = p;
  const double summed = options_.summed;
  const std::optional<Friction> friction = options_.friction;
  launch(
      "open::observe", Range(0, count_), KOKKOS_LAMBDA(int r) {
        const Vec<double, D> here = at_line.point(at_line.before + r, 0);
        const double bed_on_line = row(r).bed;
        double y = 0;
        if constexpr (D == 2) y = here.y;
        const double far = Kernel<D>::support * rows.largest_h(here.x, here.x, y, y);
        double weight = 0, level = 0, speed = 0, slip = 0;
        rows.for_each_run(here.x, here.x, y, y, far, [&](int begin, int end) {
          for (int j = begin; j < end; ++j) {
            if (kind(j) != 0) continue;
            const Vec<double, D> d = at(f.x, j) - here;
            const double q = root(dot(d, d)) * f.inv_h(j);
            if (q >= Kernel<D>::support) continue;
            const double w = f.m(j) / f.rho(j) * power<D>(f.inv_h(j)) * Kernel<D>::at(q).w;
            weight += w;
            const Vec<double, D> there = at(f.x, j), v = at(f.v, j);
            const double u = dot(v, at_line.line.inward), depth = f.rho(j) / summed,
                         b = bed_at<D>(ground, there);
            // Where it flows in, a fall would answer each particle that enters.
            const double out = smaller(u, 0.0),
                         lower =
                             fall<D>(friction, depth, out, {there, at_line.inside(there), bed_on_line - b});
            level += w * (depth + b + lower);
            speed += w * u;
            slip += w * dot(v, at_line.line.tangent);
          }
        });
        row(r).wet = weight > 0;
        if (weight <= 0) return;
        row(r).level = level / weight;
        row(r).speed = speed / weight;
        row(r).slip = slip / weight;
      });
}

template <int D>
Crossed OpenBuffer<D>::convert(FieldSet& particles, const Particles<D>& p,
                               const std::optional<BedTerm<D>>& bed) {
  const Frame at_line = frame();
  const auto row = row_;
  const auto extent = extent_;
  const Exterior<D> exterior{bed, options_.friction, least_depth()};
  const Particles<D> f = p;
  const Field<int> kind = particles.integer("kind");
  const double trim = 0.75 * options_.spacing, cut = 0.25 * options_.spacing, reach = 1.25 * options_.support;
  const double deepest = 2 * buffer_, summed = options_.summed;
  const int owner = owner_;
  const auto convert_one = KOKKOS_LAMBDA(int i)->Addends<2> {
    Addends<2> in_out{};
    const Vec<double, D> x = at(f.x, i);
    const double inside = at_line.inside(x);
    const bool leaves = kind(i) == 0 && inside < 0 && inside > -deepest && at_line.beside(x, 1);
    if (!leaves && kind(i) != owner) return in_out;
    const int r = at_line.row(x);
    const OpenRow state = row(at_line.state(r));
    if (leaves && state.closed) return bounce<D>(f, i, inside, at_line.line.inward), in_out;
    // Enters with the depth on the line, not that of where it was last.
    if (!leaves && inside >= 0 && at_line.on_line(r)) {
      set_depth<D>(f, i, summed * larger(state.depth, exterior.least));
      kind(i) = 0;
      in_out[0] = f.m(i);
      return in_out;
    }
    if (leaves) {
      kind(i) = owner;
      in_out[1] = f.m(i);
      f.kh(i) = f.rho(i) * power<D>(f.h(i));  // goes on from its h, also where that was at a bound
    }
    const double rho = summed * exterior.depth(state, x, inside);
    set_depth<D>(f, i, rho);
    f.rate(i) = 0;
    f.h(i) = smoothing_length<D>(f.kh(i), rho);
    put(f.v, i, exterior.velocity(state, at_line.line));
    put(f.v_pred, i, exterior.velocity(state, at_line.line));
    const RowPart part = extent(r);
    const bool short_of = !at_line.on_line(r) && -inside < part.from + cut;
    // Water that left stretched stands in fewer, longer particles: they must still fill the support of what
    // follows.
    if (-inside > larger(part.to + trim, reach * f.h(i)) || short_of || !at_line.beside(x, 1)) f.id(i) = -1;
    return in_out;
  };
  const int n = particles.size();
  const auto crossed = sum_of_slices<2>(
      "open::convert", blocks(n), KOKKOS_LAMBDA(int b) {
        const Lanes me = block(b, n);
        const Lane outside =
            dot(broadcast(at_line.line.origin) - me.load(f.x), broadcast(at_line.line.inward));
        const bool concerned = any((Lane(0.0) < outside) | owned_by(owner, me.load(kind)));  // hardly any is
        return concerned ? addends_of<2>(me, convert_one) : LaneAddends<2>{};
      });
  return {crossed[0], crossed[1]};
}

// Where each row has room for particles, and for how many in all.
template <int D>
int OpenBuffer<D>::count_room(const FieldSet& particles, const VecField<double, D>& x) {
  const Frame at_line = frame();
  const auto extent = extent_;
  const int total = total_, owner = owner_;
  const Field<int> id = particles.integer("id"), kind = particles.integer("kind");
  const Field<double> farthest = farthest_, nearest = nearest_;
  const double dx = options_.spacing;
  constexpr double none = 1e300;
  launch(
      "open::start_rows", Range(0, total), KOKKOS_LAMBDA(int r) {
        farthest(r) = extent(r).from - 0.5 * dx;
        nearest(r) = none;
      });
  const int n = particles.size();
  launch(
      "open::edges", Range(0, blocks(n)), KOKKOS_LAMBDA(int b) {
        const Lanes me = block(b, n);
        if (!any(owned_by(owner, me.load(kind)))) return;
        for (int i = me.first; i < me.first + me.count; ++i) {
          if (id(i) < 0 || kind(i) != owner) continue;
          const int r = at_line.row(at(x, i));
          Kokkos::atomic_fetch_max(&farthest(r), -at_line.inside(at(x, i)));
          Kokkos::atomic_fetch_min(&nearest(r), -at_line.inside(at(x, i)));
        }
      });
  const Field<int> room = room_, inner_room = inner_room_;
  int added = 0;
  Kokkos::parallel_scan(
      "open::room", Range(0, total + 1), KOKKOS_LAMBDA(int r, int& sum, bool last) {
        if (last) room(r) = sum;
        if (r == total) return;
        // nothing that crosses the line fills it from within
        const bool wedge = !at_line.on_line(r) && nearest(r) < none;
        inner_room(r) =
            wedge ? static_cast<int>(larger(0.0, ::floor((nearest(r) - extent(r).from - 0.25 * dx) / dx)))
                  : 0;
        sum += inner_room(r) +
               static_cast<int>(larger(0.0, ::floor((extent(r).to + 0.25 * dx - farthest(r)) / dx)));
      });
  Kokkos::deep_copy(added, Kokkos::subview(room, total));
  return added;
}

template <int D>
void OpenBuffer<D>::insert(FieldSet& particles, const Bind<D>& bind, const std::optional<BedTerm<D>>& bed,
                           int& next_id) {
  const int added = count_room(particles, bind().x);
  if (added == 0) return;
  const Frame at_line = frame();
  const auto row = row_;
  const int n = particles.size(), total = total_, owner = owner_;
  const Field<double> farthest = farthest_, nearest = nearest_;
  const Field<int> room = room_, inner_room = inner_room_;
  const double dx = options_.spacing;
  particles.resize(n + added);
  const Particles<D> f = bind();
  const Field<int> new_id = particles.integer("id"), new_kind = particles.integer("kind");
  const bool calibrated = particles.has("calibration");
  const Field<double> calibration = calibrated ? particles.real("calibration") : Field<double>();
  const Exterior<D> exterior{bed, options_.friction, least_depth()};
  const double area = D == 1 ? dx : dx * width_, h = options_.eta * (D == 1 ? area : root(area)),
               summed = options_.summed;
  const int first_id = take_ids(next_id, added);
  launch(
      "open::insert", Range(0, total), KOKKOS_LAMBDA(int r) {
        const OpenRow& state = row(at_line.state(r));
        for (int k = room(r); k < room(r + 1); ++k) {
          const int i = n + k, turn = k - room(r), outer = turn - inner_room(r);
          const double outside = outer < 0 ? nearest(r) - (turn + 1) * dx : farthest(r) + (outer + 1) * dx;
          const Vec<double, D> here = at_line.point(r, -outside);
          const double depth = exterior.depth(state, here, -outside);
          put(f.x, i, here);
          put(f.v, i, exterior.velocity(state, at_line.line));
          put(f.v_pred, i, exterior.velocity(state, at_line.line));
          f.m(i) = depth * area;
          f.rho(i) = summed * depth;
          f.rate(i) = 0;
          f.h0(i) = h;
          f.kh(i) = depth * power<D>(h);
          f.h(i) = smoothing_length<D>(f.kh(i), f.rho(i));
          if (calibrated) calibration(i) = 1;
          new_id(i) = first_id + k;
          new_kind(i) = owner;
        }
      });
}

template <int D>
double OpenBuffer<D>::straddling(const Particles<D>& p, const Field<int>& kind, int n) const {
  const Frame at_line = frame();
  const Particles<D> f = p;
  const int owner = owner_;
  return sum_of_particles<1>(
      "open::straddling", n, KOKKOS_LAMBDA(int i) {
        const Vec<double, D> x = at(f.x, i);
        const double row = at_line.along(x);
        if ((kind(i) != 0 && kind(i) != owner) || row < 0 || row > at_line.count) return Addends<1>{};
        const double inside = at_line.inside(x), area = f.m(i) / f.rho(i), width = D == 1 ? area : root(area);
        const double across = larger(0.0, 0.5 - (inside < 0 ? -inside : inside) / width);
        return Addends<1>{(kind(i) == 0 ? -across : across) * f.m(i)};
      })[0];
}

template class OpenBuffer<1>;
template class OpenBuffer<2>;

}  // namespace freshet::swe
