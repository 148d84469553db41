// The free surface's matrix found anew in every product against the stored one.
#include <catch2/catch.hpp>

#include "kernels/sisph/pairs/closure.hpp"
#include "kernels/sisph/surface/surface.hpp"
#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

constexpr double dx = 0.1, smoothing = 1.5;  // m, l / dx

struct Setting {
  double disorder = 0;
  bool walls = false, islands = false, friction = false;
  KernelChoice kernel = kernel::Cubic{};
};

// A basin of 16 x 16 cells, its rim held unless there are walls, under waves; deep, or with a bed that stands
// out of the water.
struct Basin {
  FieldSet fields;
  RowOrder order{2, dx, test::wide(dx)};
  AnyKernel<2> kernel;
  sisph::Geometry<2> g;
  sisph::ClosureReport closure;
  sisph::Layer<2> water;
  VecField<double, 2> before;

  explicit Basin(const Setting& setting) : kernel(make_kernel<2>(setting.kernel, smoothing, false)) {
    constexpr int cells = 16, rim = 4;
    std::vector<Point> points = test::lattice(2, {0, cells, 0, cells}, dx);
    test::Random random(11);
    std::vector<int> held;
    const auto at_rim = [&](double c) { return c < rim * dx || c > (cells - rim) * dx; };
    for (Point& p : points) {
      held.push_back(!setting.walls && (at_rim(p[0]) || at_rim(p[1])) ? 1 : 0);
      for (std::size_t k = 0; k < 2; ++k) p[k] += random(-setting.disorder, setting.disorder) * dx;
    }
    fields = test::point_fields(2, points);
    const Field<int> kind = fields.integer("kind", "1", Carry::sort);
    for (int i = 0; i < fields.size(); ++i)
      kind(i) = held[static_cast<std::size_t>(i)], fields.real("h")(i) = smoothing * dx;
    order.sort(fields);
    const double support = std::visit([](const auto& k) { return k.support; }, kernel);
    order.measure_reach(fields, fields.real("h"), support);
    sisph::GeometryRequest<2> request{order.rows(), fields.vector<2>("x", "y"), fields.real("h"), kind, dx,
                                      dx * dx};
    const double end = cells * dx;
    if (setting.walls)
      request.walls = sisph::MirrorWalls<2>({{{0, 0}, {end, 0}, {end, end}, {0, end}, {0, 0}}}, 0);
    g = sisph::measure_geometry<2>(fields.size(), kernel, request);
    closure = sisph::close_areas(g);
    fill(setting, random);
  }

  Field<double> scratch() const {
    return Field<double>("scratch", static_cast<std::size_t>(g.images.slots()) + lanes);
  }
  void fill(const Setting& setting, test::Random& random) {
    water = {scratch(), scratch(), {scratch(), scratch()}};
    before = {scratch(), scratch()};
    for (int i = 0; i < fields.size(); ++i) {
      const double x = g.x.x(i), y = g.x.y(i);
      water.bed(i) = setting.islands ? 0.3 * std::sin(9 * x) * std::sin(7 * y) - 0.1 : -1;
      water.depth(i) = std::max(0.0, 0.05 * std::sin(4 * x + y) - water.bed(i));
      before.x(i) = random(-0.3, 0.3), before.y(i) = random(-0.3, 0.3);
    }
  }

  // After a pass and a half, so that the depths of the pass before are none of those at n.
  std::unique_ptr<sisph::FreeSurface<2>> solved(const Setting& setting, bool recomputed) const {
    std::optional<sisph::PairSource<2>> source;
    if (recomputed) source = sisph::PairSource<2>{kernel, smoothing * dx, closure.lambda};
    auto surface = std::make_unique<sisph::FreeSurface<2>>(g, order.rows(), sisph::SurfaceOptions{}, source);
    if (setting.friction) {
      const Field<double> drag = surface->make_drag();
      for (int i = 0; i < fields.size(); ++i) drag(i) = 0.2 + 0.1 * std::sin(3.0 * i);
    }
    surface->start(water);
    for (int pass = 0; pass < 2; ++pass) (void)surface->solve(g.slices, water, before, 0.05, setting.islands);
    return surface;
  }
};

// Every a_ij of the rows that are solved for, and the product with a vector of random values.
std::pair<std::vector<double>, std::vector<double>> matrix(const Basin& basin,
                                                           const sisph::FreeSurface<2>& surface) {
  std::vector<double> entries, sums;
  const Field<double> x = basin.scratch();
  test::Random random(5);
  for (int i = 0; i < basin.fields.size(); ++i) x(i) = random(-1, 1);
  std::visit(
      [&](const auto& a) {
        for (int k = 0; k < basin.g.slices.count; ++k) {
          const int s = basin.g.slices(k), count = basin.g.pairs(s).count;
          a.for_each(basin.g.pairs, s, [&](int, PairIndex, Lane value) {
            for (int l = 0; l < count; ++l) entries.push_back(lane_of(value, l));
          });
          const Lane sum = a.weighted_sum(basin.g.pairs, s, x);
          for (int l = 0; l < count; ++l) sums.push_back(lane_of(sum, l));
        }
      },
      surface.pairs());
  return {entries, sums};
}

double largest_of(const std::vector<double>& a) {
  double most = 0;
  for (const double v : a) most = std::max(most, std::abs(v));
  return most;
}
double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

void compare(const Setting& setting) {
  const Basin basin(setting);
  REQUIRE((basin.g.images.count > 0) == setting.walls);
  const auto [stored, stored_sums] = matrix(basin, *basin.solved(setting, false));
  const auto [found, found_sums] = matrix(basin, *basin.solved(setting, true));
  // Round-off of the same formulas; where water comes and goes that of the depths between the passes, too.
  const double round_off = 1e-13;
  REQUIRE(largest_of(stored) > 0);
  CHECK(largest_difference(stored, found) <= round_off * largest_of(stored));
  CHECK(largest_difference(stored_sums, found_sums) <= 10 * round_off * largest_of(stored_sums));
}

}  // namespace

TEST_CASE("sisph coefficients: found anew they are the stored ones, on a lattice and moved off it") {
  compare({});
  compare({0.2});
}

TEST_CASE("sisph coefficients: the same beside walls, with friction, with dry islands") {
  compare({0.2, true});
  compare({0.2, false, true});
  compare({0.2, true, true, true});
}

TEST_CASE("sisph coefficients: the same for every kernel") {
  const KernelChoice kernel = GENERATE(as<KernelChoice>{}, kernel::Quartic{}, kernel::Quintic{},
                                       kernel::Gaussian{}, kernel::Wendland{});
  compare({0.2, true, false, false, kernel});
}
