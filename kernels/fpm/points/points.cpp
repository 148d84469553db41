#include "kernels/fpm/points/points.hpp"

#include "cellgrid/parallel/launch.hpp"
#include "kernels/fpm/points/holding.hpp"
#include "kernels/fpm/points/merging.hpp"
#include "kernels/water/ids.hpp"

namespace freshet::fpm {
namespace {

// x range: by how much values in a hole may exceed those around; elsewhere they do not
constexpr double beyond = 0.5;
constexpr double touching = 0.25;  // x spacing: inner points this near to a wall stand on it; beside a wall
                                   // without points water goes through
// x spacing: a surface point on a wall with no fluid point nearer than this is given up
constexpr double lonely = 1.5;

// The closeness rules on the fields of a set.
struct Pairing {
  Cloud cloud;
  Field<int> side, surface;
  double merge, land;  // x spacing

  KOKKOS_FORCEINLINE_FUNCTION Closeness of(int i) const {
    return {cloud.kind(i), side(i), surface(i) == 1, cloud.id(i)};
  }
  KOKKOS_FORCEINLINE_FUNCTION Fate fate(int i, int j, double r2) const {
    const double near = land * cloud.spacing_at(i);
    return fate_of(cloud.tank, of(i), of(j), r2 < near * near);
  }
  KOKKOS_INLINE_FUNCTION Closest closest(int i) const {
    Closest best;
    cloud.near.for_each(at(cloud.near.x, i), merge * cloud.spacing_at(i),
                        [&](int j, const Vec<double, 2>&, double r2) {
                          if (j != i && (fate(i, j, r2) != keep || fate(j, i, r2) != keep))
                            best.look_at(j, r2, cloud.id(i), cloud.id(j));
                        });
    return best;
  }
  KOKKOS_INLINE_FUNCTION bool is_lonely(int i) const {
    if (cloud.kind(i) == in_fluid || surface(i) == 0) return false;
    bool found = false;
    cloud.near.for_each(
        at(cloud.near.x, i), lonely * cloud.spacing_at(i),
        [&](int j, const Vec<double, 2>&, double) { found = found || cloud.kind(j) == in_fluid; });
    return !found;
  }
};

// Of several places where a point is missing, near each other, the one of the greatest kind, size and
// smallest id counts.
struct Choice {
  Cloud cloud;
  Kokkos::View<Gap*, Memory> missing;
  Field<int> fate;
  double apart, reach;  // x spacing; reach: how far a place may be from the point that found it

  KOKKOS_INLINE_FUNCTION bool first(int i, int j) const {
    const Gap &a = missing(i), &b = missing(j);
    if (a.kind != b.kind) return a.kind > b.kind;
    return a.size > b.size || (a.size == b.size && cloud.id(i) < cloud.id(j));
  }
  KOKKOS_INLINE_FUNCTION bool accepted(int i) const {
    if (missing(i).kind == Gap::none || fate(i) != keep) return false;
    bool best = true;
    const double close = apart * cloud.spacing_at(i);
    cloud.near.for_each(missing(i).x, reach * cloud.spacing_at(i) + close,
                        [&](int j, const Vec<double, 2>&, double) {
                          if (j == i || missing(j).kind == Gap::none) return;
                          const Vec<double, 2> d = cloud.near.period.shortest(missing(j).x - missing(i).x);
                          if (dot(d, d) < close * close && first(j, i)) best = false;
                        });
    return best;
  }
};

}  // namespace

PointKeeper::PointKeeper(const PointRule& rule, const Tank& tank, const Period& period, PointFields carried)
    : rule_(rule), tank_(tank), period_(period), carried_(std::move(carried)), voronoi_(rule.voronoi) {}

Cloud PointKeeper::cloud(const FieldSet& points, const RowOrder& order) const {
  return {{order.rows(), {points.real("x"), points.real("y")}, period_},
          points.integer("id"),
          points.integer("kind"),
          tank_.view(),
          rule_.spacing,
          points.has("dx") ? points.real("dx") : Field<double>(),
          {points.real("open_x"), points.real("open_y")}};
}

int PointKeeper::hold_to_walls(FieldSet& points) {
  const VecField<double, 2> x{points.real("x"), points.real("y")};
  const Field<int> kind = points.integer("kind"), side = points.integer("side"),
                   surface = points.integer("surface");
  const TankView tank = tank_.view();
  const Period period = period_;
  const double reach = 2 * rule_.spacing, close = touching * rule_.spacing;
  int landed = 0;
  Kokkos::parallel_reduce(
      "fpm::hold", Range(0, points.size()),
      KOKKOS_LAMBDA(int i, int& count) {
        const Standing now = hold(tank, {at(x, i), kind(i), side(i)}, reach, surface(i) ? 0.0 : close);
        count += kind(i) == in_fluid && now.kind != in_fluid;
        put(x, i, period.wrap(now.x));
        kind(i) = now.kind;
        side(i) = now.side;
      },
      landed);
  return landed;
}

void PointKeeper::choose_partners(const Cloud& cloud, const Field<int>& surface, const Field<int>& side,
                                  int n) {
  reserve(partner_, "fpm.partner", n);
  const Field<int> partner = partner_;
  const Pairing pairing{cloud, side, surface, rule_.merge * rule_.support / rule_.spacing, rule_.land};
  launch(
      "fpm::partners", Range(0, n), KOKKOS_LAMBDA(int i) { partner(i) = pairing.closest(i).partner; });
}

PointCount PointKeeper::decide(const Cloud& cloud, const Field<int>& surface, const Field<int>& side, int n) {
  reserve(fate_, "fpm.fate", n);
  const Field<int> partner = partner_, fate = fate_;
  const Pairing pairing{cloud, side, surface, rule_.merge * rule_.support / rule_.spacing, rule_.land};
  const Period period = period_;
  PointCount count;
  Kokkos::parallel_reduce(
      "fpm::decide", Range(0, n),
      KOKKOS_LAMBDA(int i, long& merged, long& removed) {
        const int j = partner(i);
        fate(i) = keep;
        if (j >= 0 && partner(j) == i) {
          const Vec<double, 2> d = period.shortest(at(cloud.near.x, j) - at(cloud.near.x, i));
          fate(i) = pairing.fate(i, j, dot(d, d));
        } else if (pairing.is_lonely(i)) {
          fate(i) = drop;
        }
        merged += fate(i) == move;
        removed += fate(i) == drop;
      },
      count.merged, count.removed);
  count.removed -= count.merged;  // the other half of each merged pair
  return count;
}

int PointKeeper::list_places(const Cloud& cloud, const Field<int>& side, int n, int merged) {
  const Choice choice{cloud, voronoi_.missing(), fate_, rule_.apart, 1.5 * rule_.voronoi.surface};
  reserve(owner_, "fpm.owner", merged + n);
  for (auto* view : {&where_.x, &where_.y, &place_h_, &place_slack_}) reserve(*view, "fpm.where", merged + n);
  for (auto* view : {&place_kind_, &place_side_}) reserve(*view, "fpm.place", merged + n);
  const Field<int> owner = owner_, fate = fate_, partner = partner_, place_kind = place_kind_,
                   place_side = place_side_;
  const VecField<double, 2> where = where_, x = cloud.near.x;
  const Field<double> place_h = place_h_, slack = place_slack_;
  const double support = rule_.support / rule_.spacing;
  const Period period = period_;
  Kokkos::parallel_scan(
      "fpm::merged_places", Range(0, n), KOKKOS_LAMBDA(int i, int& k, bool last) {
        if (fate(i) != move) return;
        if (last) {
          owner(k) = i;
          put(where, k, period.wrap(at(x, i) + 0.5 * period.shortest(at(x, partner(i)) - at(x, i))));
          place_kind(k) = cloud.kind(i), place_side(k) = side(i);
          place_h(k) = support * cloud.spacing_at(i);
          slack(k) = 0;
        }
        ++k;
      });
  int count = 0;
  const auto missing = voronoi_.missing();
  Kokkos::parallel_scan(
      "fpm::new_places", Range(0, n),
      KOKKOS_LAMBDA(int i, int& k, bool last) {
        if (!choice.accepted(i)) return;
        const Gap& m = missing(i);
        if (last) {
          owner(merged + k) = i;
          put(where, merged + k, m.x);
          place_kind(merged + k) = m.kind == Gap::at_wall     ? on_wall
                                   : m.kind == Gap::at_corner ? in_corner
                                                              : in_fluid;
          place_side(merged + k) = m.side;
          place_h(merged + k) = support * cloud.spacing_at(i);
          slack(merged + k) = m.kind == Gap::in_bulk ? beyond : 0.0;
        }
        ++k;
      },
      count);
  return count;
}

// Copies of their owners in every field, then what the fit says in the fields that are carried.
void PointKeeper::fill_places(FieldSet& points, int merged, int count) {
  const int n = points.size(), places = merged + count;
  points.append_copies(Kokkos::subview(owner_, std::make_pair(merged, places)), count);
  reserve(value_, "fpm.value", places);
  std::vector<std::string> names = carried_.scalars;
  for (const auto& v : carried_.velocities) names.insert(names.end(), v.begin(), v.end());
  const Field<int> owner = owner_;
  const Field<double> value = value_;
  for (const std::string& name : names) {
    const Field<double> field = points.real(name);
    transfer_.apply(field, value, place_slack_);
    launch(
        "fpm::fill", Range(0, places),
        KOKKOS_LAMBDA(int k) { field(k < merged ? owner(k) : n + k - merged) = value(k); });
  }
}

void PointKeeper::settle_places(FieldSet& points, int n, int merged, int& next_id) {
  const int places = merged + points.size() - n, first_id = take_ids(next_id, places - merged);
  const VecField<double, 2> x{points.real("x"), points.real("y")},
      where = where_, open{points.real("open_x"), points.real("open_y")};
  const Field<double> slack = place_slack_;
  const Field<int> kind = points.integer("kind"), side = points.integer("side"), id = points.integer("id");
  const Field<int> owner = owner_, fate = fate_, place_kind = place_kind_, place_side = place_side_;
  launch(
      "fpm::drop", Range(0, n), KOKKOS_LAMBDA(int i) {
        if (fate(i) == drop) id(i) = -1;
      });
  launch(
      "fpm::settle", Range(0, places), KOKKOS_LAMBDA(int k) {
        const int i = k < merged ? owner(k) : n + k - merged;
        put(x, i, at(where, k));
        kind(i) = place_kind(k), side(i) = place_side(k);
        if (k < merged) return;
        id(i) = first_id + k - merged;
        if (slack(k) > 0 || kind(i) != in_fluid)
          put(open, i, {});  // those on surface edges have their owner's
      });
}

void PointKeeper::hold_velocities(FieldSet& points) {
  const Field<int> kind = points.integer("kind"), side = points.integer("side");
  const TankView tank = tank_.view();
  const bool slip = rule_.slip;
  for (const auto& names : carried_.velocities) {
    const VecField<double, 2> v{points.real(names[0]), points.real(names[1])};
    launch(
        "fpm::hold_velocity", Range(0, points.size()), KOKKOS_LAMBDA(int i) {
          if (kind(i) == in_fluid) return;
          const Vec<double, 2> n = tank.normal(side(i), kind(i)), u = at(v, i);
          put(v, i, kind(i) == on_wall && slip ? u - dot(u, n) * n : Vec<double, 2>{});
        });
  }
}

PointReport PointKeeper::flag(FieldSet& points, const RowOrder& order) {
  const VoronoiReport r = voronoi_.find(cloud(points, order), points.size(), points.integer("surface"), true);
  return {r.surface, r.failed, {}};
}

PointReport PointKeeper::manage(FieldSet& points, RowOrder& order, int& next_id) {
  const int landed = hold_to_walls(points);
  order.sort(points);
  const int n = points.size();
  const Cloud here = cloud(points, order);
  const Field<int> surface = points.integer("surface"), side = points.integer("side");
  const VoronoiReport cells = voronoi_.find(here, n, surface);
  choose_partners(here, surface, side, n);
  PointReport report{cells.surface, cells.failed, decide(here, surface, side, n)};
  const int merged = static_cast<int>(report.step.merged), count = list_places(here, side, n, merged);
  report.step.inserted = count;
  report.step.landed = landed;
  if (merged + count + report.step.removed > 0) {
    transfer_.find(here.near, where_, place_h_, merged + count);
    fill_places(points, merged, count);
    settle_places(points, n, merged, next_id);
    order.sort(points);
    const PointReport after = flag(points, order);
    report.surface = after.surface, report.failed += after.failed;
  }
  hold_velocities(points);
  return report;
}

}  // namespace freshet::fpm
