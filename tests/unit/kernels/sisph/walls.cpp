// Mirror pairs at walls: planes through the nearest point to the middle of a pair, images through
// right-angled corners.
#include "kernels/sisph/walls/mirror_walls.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using sisph::MirrorWalls;
using V2 = Vec<double, 2>;

namespace {

struct Mirrored {
  V2 x;
  Sym<double, 2> r;
};
std::vector<Mirrored> images(const MirrorWalls<2>& walls, V2 xi, V2 xj, double support) {
  std::vector<Mirrored> found;
  walls.for_each_image(xi, xj, support, [&](const V2& x, const Sym<double, 2>& r) {
    found.push_back({x, r});
  });
  return found;
}

Polyline box(double width, double height) {
  return {{0, 0}, {width, 0}, {width, height}, {0, height}, {0, 0}};
}
Polyline circle(double radius, int corners) {
  Polyline line;
  for (int k = 0; k <= corners; ++k) {
    const double angle = 2 * pi * (k % corners) / corners;
    line.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return line;
}

double distance(const V2& a, const V2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

TEST_CASE("sisph walls: a straight wall mirrors places and velocities") {
  const MirrorWalls<2> walls({box(10, 10)}, 0);
  const auto found = images(walls, {3, 0.2}, {3.1, 0.3}, 1);
  REQUIRE(found.size() == 1);
  CHECK(found[0].x.x == Approx(3.1));
  CHECK(found[0].x.y == Approx(-0.3));
  const V2 turned = found[0].r * V2{2.0, 5.0};
  CHECK(turned.x == Approx(2));
  CHECK(turned.y == Approx(-5));
  CHECK(images(walls, {3, 0.2}, {3.1, 0.3}, 0.5).empty());  // the image is 0.51 away
  CHECK(images(walls, {3, 3}, {3.1, 3}, 1).empty());
}

TEST_CASE("sisph walls: a particle near a wall pairs with its own image") {
  const MirrorWalls<2> walls({box(10, 10)}, 0);
  const auto found = images(walls, {9.8, 5}, {9.8, 5}, 1);
  REQUIRE(found.size() == 1);
  CHECK(found[0].x.x == Approx(10.2));
}

TEST_CASE("sisph walls: a right-angled corner adds the image through it") {
  const MirrorWalls<2> walls({box(10, 10)}, 0);
  const auto found = images(walls, {0.2, 0.3}, {0.4, 0.1}, 2);
  REQUIRE(found.size() == 3);
  CHECK(walls.slanting_corners() == 0);
  bool through = false;
  for (const Mirrored& image : found)
    if (distance(image.x, {-0.4, -0.1}) < 1e-14)
      through = image.r.xx == -1 && image.r.yy == -1 && image.r.xy == 0;
  CHECK(through);
}

TEST_CASE("sisph walls: a curved wall has one plane per pair, the same seen from both sides") {
  const double radius = 1, support = 0.2;
  const MirrorWalls<2> walls({circle(radius, 400)}, 0);
  test::Random random(5);
  int seen = 0;
  for (int n = 0; n < 400; ++n) {
    const double angle = random(0, 2 * pi), r = random(0.85, 0.99);
    const V2 a{r * std::cos(angle), r * std::sin(angle)},
        b{a.x + random(-0.05, 0.05), a.y + random(-0.05, 0.05)};
    if (std::hypot(b.x, b.y) > 0.999) continue;
    const auto of_b = images(walls, a, b, support), of_a = images(walls, b, a, support);
    REQUIRE(of_a.size() == of_b.size());
    REQUIRE(of_b.size() <= 1);
    if (of_b.empty()) continue;
    ++seen;
    CHECK(distance(a, of_b[0].x) == Approx(distance(b, of_a[0].x)).epsilon(1e-12));
    CHECK(of_b[0].r.xy == of_a[0].r.xy);
    // The direction to the image, seen from the other side, is its reflection: fluxes cancel.
    const V2 d = of_b[0].r * V2{of_b[0].x.x - a.x, of_b[0].x.y - a.y};
    CHECK(d.x == Approx(-(of_a[0].x.x - b.x)).margin(1e-12));
    CHECK(d.y == Approx(-(of_a[0].x.y - b.y)).margin(1e-12));
  }
  CHECK(seen > 100);
}

TEST_CASE("sisph walls: a bend with the water outside mirrors at the nearest point of both sides") {
  // Water round the outside of a block: its outline runs clockwise.
  const MirrorWalls<2> walls({{{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}}}, 0);
  CHECK(walls.slanting_corners() == 0);
  const auto beside = images(walls, {-0.1, 0.5}, {-0.1, 0.6}, 1);
  REQUIRE(beside.size() == 1);
  CHECK(beside[0].x.x == Approx(0.1));
  const auto at_corner = images(walls, {-0.1, 1.1}, {-0.1, 1.1}, 1);
  REQUIRE(at_corner.size() == 1);
  CHECK(at_corner[0].x.x == Approx(0.1));
  CHECK(at_corner[0].x.y == Approx(0.9));
}

TEST_CASE("sisph walls: pairs that a wall separates") {
  const MirrorWalls<2> walls({{{0.5, 0}, {0.5, 1}}}, 0);
  CHECK(walls.part({0.4, 0.5}, {0.6, 0.5}));
  CHECK_FALSE(walls.part({0.4, 1.2}, {0.6, 1.2}));
  CHECK_FALSE(walls.part({0.4, 0.5}, {0.45, 0.9}));
  CHECK(images(walls, {0.4, 0.5}, {0.4, 0.6}, 1).size() == 1);
  CHECK(images(walls, {0.6, 0.5}, {0.6, 0.6}, 1).empty());  // the water is on the left of the line
}

TEST_CASE("sisph walls: free ends go on behind an opening") {
  const Polyline south{{0, 0}, {10, 0}};
  CHECK(images(MirrorWalls<2>({south}, 0), {-0.5, 0.1}, {-0.4, 0.1}, 1).empty());
  CHECK(images(MirrorWalls<2>({south}, 1), {-0.5, 0.1}, {-0.4, 0.1}, 1).size() == 1);
}

TEST_CASE("sisph walls: four separate walls make a box") {
  const MirrorWalls<2> walls({{{0, 0}, {4, 0}}, {{4, 3}, {0, 3}}, {{4, 0}, {4, 3}}, {{0, 3}, {0, 0}}}, 1);
  CHECK(images(walls, {3.9, 2.9}, {3.9, 2.9}, 1).size() == 3);
  CHECK(images(walls, {0.1, 0.1}, {0.1, 0.1}, 1).size() == 3);
}

TEST_CASE("sisph walls: of many chains near a pair each mirrors as if it stood alone, in order") {
  // Three coasts of 2000 sides each, 0.1 apart round the water, and islands with the water outside.
  std::vector<Polyline> lines;
  for (const double radius : {2.0, 2.1, 2.2}) lines.push_back(circle(radius, 2000));
  for (int k = 0; k < 8; ++k) {
    Polyline island = circle(0.02, 40);
    for (auto& p : island) p = {1.9 * std::cos(k) + p[0], 1.9 * std::sin(k) + p[1]};
    lines.emplace_back(island.rbegin(), island.rend());
  }
  const MirrorWalls<2> walls(lines, 0);
  std::vector<MirrorWalls<2>> each;
  for (const Polyline& line : lines) each.push_back(MirrorWalls<2>({line}, 0));
  test::Random random(11);
  std::size_t most = 0;
  for (int n = 0; n < 400; ++n) {
    const double r = random(1.7, 1.99), angle = random(-pi, pi);
    const V2 xi{r * std::cos(angle), r * std::sin(angle)},
        xj{xi.x + random(-0.1, 0.1), xi.y + random(-0.1, 0.1)};
    const auto found = images(walls, xi, xj, 0.5);
    std::vector<Mirrored> alone;
    bool parted = false, near = false;
    for (const auto& one : each) {
      for (const Mirrored& image : images(one, xi, xj, 0.5)) alone.push_back(image);
      parted = parted || one.part(xi, xj);
      near = near || one.near(xi, 0.05);
    }
    REQUIRE(found.size() == alone.size());
    // The same arithmetic, compiled once: no tolerance.
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(distance(found[k].x, alone[k].x) == 0);
    CHECK(walls.part(xi, xj) == parted);
    CHECK(walls.near(xi, 0.05) == near);
    most = std::max(most, found.size());
  }
  CHECK(most >= 4);
}

TEST_CASE("sisph walls: in one dimension a wall is a point") {
  const MirrorWalls<1> walls({{{2, 0}}}, 0);
  int count = 0;
  walls.for_each_image({2.1}, {2.3}, 1, [&](const Vec<double, 1>& x, const Sym<double, 1>& r) {
    ++count;
    CHECK(x.x == Approx(1.7));
    CHECK(r.xx == -1);
  });
  CHECK(count == 1);
  CHECK(walls.part({1.9}, {2.1}));
  CHECK_FALSE(walls.part({2.2}, {2.1}));
}
