// What crosses a wall all the same is put back.
#include "kernels/boundaries/walls/walls.hpp"

#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;

namespace {

constexpr double dx = 0.1;       // m
constexpr double depth = 0.7;    // m
constexpr double far = 30 * dx;  // m, where walls end

// Corners at the origin.
const Polyline straight{{-far, 0}, {far, 0}}, right_angle{{0, far}, {0, 0}, {far, 0}},
    re_entrant{{-far, 0}, {0, 0}, {0, -far}};

struct Moving {
  Point x, v;
};

// One particle, put at q.x after the list was made where it was near the wall, then reflected.
template <int D>
Moving reflected(const std::vector<Polyline>& lines, const Point& inside, const Point& before,
                 const Moving& q) {
  const double area = D == 1 ? dx : dx * dx;
  Cloud<D> cloud({{before, q.v, depth * area, depth, 1.2 * dx}}, dx);
  cloud.add_walls(lines, inside);
  cloud.solve(test::fixed_h());
  const swe::Particles<D> p = cloud.bind();
  put(p.x, 0, to_vec<D>(q.x));
  put(p.v_pred, 0, 2.0 * to_vec<D>(q.v));
  cloud.walls->reflect(cloud.clusters, p.x, p.v, p.v_pred);
  const Vec<double, D> v = at(p.v, 0), v_pred = at(p.v_pred, 0);
  CHECK(v_pred.x == Approx(2 * v.x));  // both velocities alike
  if constexpr (D == 1) return {{p.x.x(0), 0}, {v.x, 0}};
  else return {{p.x.x(0), p.x.y(0)}, {v.x, v.y}};
}

void require_at(const Moving& q, const Point& x, const Point& v) {
  for (size_t k = 0; k < 2; ++k) {
    CAPTURE(k);
    CHECK(q.x[k] == Approx(x[k]).margin(1e-14));
    CHECK(q.v[k] == Approx(v[k]).margin(1e-14));
  }
}

}  // namespace

TEST_CASE("walls: what crosses a straight wall is put back") {
  const Point before{0.02, 0.02};
  require_at(reflected<2>({straight}, {0, 1}, before, {{0.03, -0.01}, {1, -2}}), {0.03, 0.01}, {1, 2});
  require_at(reflected<2>({straight}, {0, 1}, before, {{0.03, -0.01}, {1, 2}}), {0.03, 0.01},
             {1, 2});  // already returning
  require_at(reflected<2>({straight}, {0, 1}, before, {{0.03, 0.01}, {1, -2}}), {0.03, 0.01},
             {1, -2});  // has not crossed
}

TEST_CASE("walls: a wall at any angle keeps the velocity along it") {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Polyline slanted{{-far * c, -far * s}, {far * c, far * s}};
  const Point before{-0.01 * s, 0.01 * c}, crossed{0.02 * s + 0.01 * c, -0.02 * c + 0.01 * s};
  const Moving q = reflected<2>({slanted}, {0, 1}, before, {crossed, {3 * c + 2 * s, 3 * s - 2 * c}});
  require_at(q, {-0.02 * s + 0.01 * c, 0.02 * c + 0.01 * s}, {3 * c - 2 * s, 3 * s + 2 * c});
}

TEST_CASE("walls: what slips behind a right corner comes back through both walls") {
  const Point before{0.02, 0.03};
  require_at(reflected<2>({right_angle}, {1, 1}, before, {{-0.01, -0.02}, {-1, -2}}), {0.01, 0.02}, {1, 2});
  require_at(reflected<2>({right_angle}, {1, 1}, before, {{-0.01, 0.02}, {-1, -2}}), {0.01, 0.02}, {1, -2});
}

TEST_CASE(
    "walls: a re-entrant corner leaves the fluid beside it alone and turns back what enters the solid") {
  for (const Point& beside : {Point{0.02, -0.04}, Point{-0.04, 0.02}, Point{0.01, 0.01}}) {
    CAPTURE(beside[0], beside[1]);
    require_at(reflected<2>({re_entrant}, {1, 1}, beside, {beside, {-1, -2}}), beside, {-1, -2});
  }
  const Moving q = reflected<2>({re_entrant}, {1, 1}, {0.01, 0.01}, {{-0.01, -0.02}, {-1, -2}});
  CHECK((q.x[0] > 0 || q.x[1] > 0));
  require_at(reflected<2>({re_entrant}, {1, 1}, {0.01, -0.5}, {{-0.01, -0.5}, {-1, -2}}), {0.01, -0.5},
             {1, -2});
}

TEST_CASE("walls: a closed box turns back at every side and corner") {
  const Polyline box{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  const Point centre{0.5, 0.5};
  require_at(reflected<2>({box}, centre, {0.98, 0.4}, {{1.02, 0.4}, {1, 1}}), {0.98, 0.4}, {-1, 1});
  require_at(reflected<2>({box}, centre, {0.98, 0.97}, {{1.02, 1.01}, {1, 1}}), {0.98, 0.99}, {-1, -1});
  require_at(reflected<2>({box}, centre, {0.02, 0.97}, {{-0.02, 1.01}, {-1, 1}}), {0.02, 0.99}, {1, -1});
  require_at(reflected<2>({box}, centre, {0.02, 0.03}, {{-0.02, -0.01}, {-1, -1}}), {0.02, 0.01}, {1, 1});
}

TEST_CASE("walls: the ends of a line turn back to the side of the water") {
  const std::vector<Polyline> ends{{{0, 0}}, {{2, 0}}};
  require_at(reflected<1>(ends, {1, 0}, {0.02, 0}, {{-0.01, 0}, {-3, 0}}), {0.01, 0}, {3, 0});
  require_at(reflected<1>(ends, {1, 0}, {1.98, 0}, {{2.01, 0}, {3, 0}}), {1.99, 0}, {-3, 0});
}
