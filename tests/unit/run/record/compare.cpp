// Error norms against an exact solution that can be written down.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/reference/exact.hpp"
#include "src/run/record/norms.hpp"
#include "tests/support/run/fake_method.hpp"

using namespace freshet;

namespace {

// Still water 2 m deep left of x = 0.5, dry right of it.
class HalfWet : public Exact {
 public:
  FlowState at(double x, double, double) const override { return {x < 0.5 ? 2.0 : -1.0, 0, 0}; }
};

Scene half_wet_scene(int dimension) {
  Scene scene;
  scene.domain.dimension = dimension;
  scene.compare.exact = std::make_shared<HalfWet>();
  return scene;
}

// Particles on a lattice over [0, width] (x [0, 1] in 2-D) with the given depth and h = 1.2 dx.
Fluid lattice(int dimension, double dx, double width, double depth) {
  Fluid fluid;
  const int columns = static_cast<int>(std::lround(width / dx)),
            rows = dimension == 2 ? static_cast<int>(1 / dx) : 1;
  for (int k = 0; k < columns * rows; ++k) {
    fluid.x.push_back((k % columns + 0.5) * dx);
    fluid.y.push_back(dimension == 2 ? (k / columns + 0.5) * dx : 0);
  }
  const std::size_t size = fluid.x.size();
  fluid.u.assign(size, 0);
  fluid.v.assign(size, 0);
  fluid.depth.assign(size, depth);
  fluid.mass.assign(size, depth * (dimension == 2 ? dx * dx : dx));
  fluid.h.assign(size, 1.2 * dx);
  fluid.id.assign(size, 0);
  return fluid;
}

// A method at rest that holds these particles.
class Held : public test::FakeMethod {
 public:
  Held(const Scene& scene, const Fluid& fluid) : FakeMethod(scene) {
    FieldSet& f = fields();
    f.resize(static_cast<int>(fluid.size()));
    const auto put = [&](const char* name, const std::vector<double>& values) {
      for (std::size_t k = 0; k < values.size(); ++k) f.real(name)(k) = values[k];
    };
    put("x", fluid.x), put("u", fluid.u), put("depth", fluid.depth), put("mass", fluid.mass),
        put("h", fluid.h);
    if (scene.domain.dimension == 2) put("y", fluid.y), put("v", fluid.v);
    for (int i = 0; i < f.size(); ++i) f.integer("id")(i) = i;
  }
};

}  // namespace

TEST_CASE("particle errors of a uniform offset") {
  const Scene scene = half_wet_scene(1);
  Fluid fluid = lattice(1, 0.01, 0.5, 2.2);
  fluid.u.assign(fluid.size(), 0.3);
  fluid.v.assign(fluid.size(), 0.4);
  const ErrorNorms errors = particle_errors(scene, fluid, 0);
  // 50 equal terms: rounding only.
  CHECK(errors.depth_l2_rel == Approx(0.1).epsilon(1e-12));
  CHECK(errors.depth_linf == Approx(0.2).epsilon(1e-12));
  CHECK(errors.velocity_l2 == Approx(0.5).epsilon(1e-12));
  CHECK(depth_l1(scene, fluid, 0) == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("the norms of the thesis are means over the particles that are wet in the exact solution") {
  Scene scene = half_wet_scene(1);
  scene.gravity = 8;                         // sqrt(g d_e) = 4 m/s
  Fluid fluid = lattice(1, 0.01, 1.0, 2.2);  // the dry half does not count: no exact depth to divide by
  fluid.u.assign(fluid.size(), 0.4);
  fluid.v.assign(fluid.size(), -0.8);
  const ErrorNorms errors = error_norms(scene, fluid, 0);
  CHECK(errors.depth_l2_mean_rel == Approx(0.1).epsilon(1e-12));  // 0.2 m of 2 m
  CHECK(errors.velocity_l2_x == Approx(0.1).epsilon(1e-12));
  CHECK(errors.velocity_l2_y == Approx(0.2).epsilon(1e-12));
  CHECK(errors.depth_l1_rel == depth_l1(scene, fluid, 0));
}

TEST_CASE("errors count only where the scene wants them") {
  Scene scene = half_wet_scene(1);
  Fluid fluid = lattice(1, 0.01, 0.5, 2.0);
  for (std::size_t k = 0; k < fluid.size(); ++k) {
    fluid.depth[k] = fluid.x[k] < 0.25 ? 2.2 : 3.0;
    fluid.mass[k] = fluid.depth[k] * 0.01;
  }
  scene.compare.where = [](double x, double) { return x < 0.25 ? 1.0 : 0.0; };
  const ErrorNorms errors = error_norms(scene, fluid, 0);
  CHECK(errors.depth_l2_rel == Approx(0.1).epsilon(1e-12));
  CHECK(errors.depth_l2_mean_rel == Approx(0.1).epsilon(1e-12));
  CHECK(errors.depth_l1_rel == Approx(0.1).epsilon(1e-12));
  CHECK(errors.depth_linf == Approx(0.2).epsilon(1e-12));
  scene.water.spacing = 0.01;
  Scene all = scene;
  all.compare.where = {};
  const Held held(scene, fluid);
  CHECK(grid_l2(scene, held, 0) <
        0.5 * grid_l2(all, held, 0));  // errors of 0.1 against 0.1 and 0.5 in halves
  scene.compare.where = [](double, double) { return 0.0; };
  CHECK(std::isnan(error_norms(scene, fluid, 0).depth_l2_rel));
}

TEST_CASE("depth_l1 leaves out what is dry in the exact solution, the other norms count it as zero depth") {
  Scene scene = half_wet_scene(1);
  const Fluid fluid = lattice(1, 0.01, 1.0, 2.0);  // water everywhere, half of it where the exact bed is dry
  CHECK(depth_l1(scene, fluid, 0) == 0);
  CHECK(particle_errors(scene, fluid, 0).depth_l2_rel == Approx(1).epsilon(1e-12));
  CHECK(particle_errors(scene, fluid, 0).depth_linf == 2.0);
  scene.compare.threshold = 3;
  CHECK(std::isnan(depth_l1(scene, fluid, 0)));
}

TEST_CASE("the median of the samples") {
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 2, 3}) == 2.5);
  CHECK(std::isnan(median({})));
}

TEST_CASE("the grid covers the domain") {
  Scene scene = half_wet_scene(2);
  scene.domain.low = {-1, 2};
  scene.domain.high = {3, 3};
  CellGrid grid = comparison_grid(scene);
  CHECK((grid.nx == 200 && grid.ny == 200));
  CHECK(grid.x(0) == Approx(-1 + 0.01));
  CHECK(grid.y(199) == Approx(3 - 0.0025));
  scene.compare.grid_spacing = 0.3;  // 13.3 and 3.3 cells: the nearest whole number of them
  grid = comparison_grid(scene);
  CHECK((grid.nx == 13 && grid.ny == 3));
  CHECK(grid.dy == Approx(1 / 3.0));
}

TEST_CASE("a uniform depth is exact on the grid inside the water and zero beyond the kernel's reach") {
  const int dimension = GENERATE(1, 2);
  Scene scene = half_wet_scene(dimension);
  const double dx = 0.02, h = 1.2 * dx;
  scene.water.spacing = dx;
  const CellGrid grid = comparison_grid(scene);
  const auto depth = depth_on_grid(grid, Held(scene, lattice(dimension, dx, 0.5, 2.0)));
  const auto at = [&](int i, int j) { return depth[static_cast<std::size_t>(j * grid.nx + i)]; };
  const int middle = dimension == 2 ? 100 : 0;
  // sum m W / sum V W = depth wherever the cover is above 0.95, whatever the kernel sum: rounding only.
  CHECK(at(50, middle) == Approx(2).epsilon(1e-12));
  for (int i = 0; i < grid.nx; ++i) {
    if (grid.x(i) > 0.5 + 2 * h) CHECK(at(i, middle) == 0);
    CHECK(at(i, middle) <= 2.0 * (1 + 1e-12));  // never more than the water there is
  }
}

TEST_CASE("grid_l2 of the right answer is the smear of the water's edge alone") {
  Scene scene = half_wet_scene(1);
  scene.water.spacing = 0.01;
  const auto error = [&](double dx) { return grid_l2(scene, Held(scene, lattice(1, dx, 0.5, 2.0)), 0); };
  // The edge is smeared over +-2h, errors below 1/2 of the depth: sqrt(4 h / 4 / 0.5) at most.
  CHECK(error(0.02) < std::sqrt(2 * 1.2 * 0.02));
  CHECK(error(0.01) < error(0.02));
  CHECK(grid_l2(scene, Held(scene, lattice(1, 0.02, 0.5, 4.0)), 0) >
        0.9);  // twice the depth is an error of 1
}
