// The geometry of lines against hand values and brute force.
#include "kernels/boundaries/walls/polyline.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using V2 = Vec<double, 2>;

namespace {

const Polyline square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const Polyline notched{{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}};  // a V cut into a box from above

Polyline closed(Polyline line) {
  line.push_back(line.front());
  return line;
}
Polyline reversed(Polyline line) {
  std::reverse(line.begin(), line.end());
  return line;
}

// Counter-clockwise round the centre, radii between 0.2 and 1: concave, with sharp corners, never across
// itself.
Polyline star(int corners, const Point& centre, unsigned seed) {
  test::Random random(seed);
  Polyline line;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * (k + random(0, 0.9)) / corners, r = random(0.2, 1);
    line.push_back({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle)});
  }
  return line;
}

// How often the polygon goes round p, by the angles under which its sides are seen.
double windings(const Polyline& polygon, const Point& p) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    sum += turn(to_vec<2>(polygon[k]) - to_vec<2>(p),
                to_vec<2>(polygon[(k + 1) % polygon.size()]) - to_vec<2>(p));
  return sum / (2 * pi);
}

NearestPiece nearest(const std::vector<Piece>& pieces, const Point& p, double reach, bool backwards = false) {
  NearestPiece found(reach);
  const int n = static_cast<int>(pieces.size());
  for (int i = 0; i < n; ++i) {
    const int k = backwards ? n - 1 - i : i;
    found.look_at(k, pieces[static_cast<std::size_t>(k)], to_vec<2>(p));
  }
  return found;
}

}  // namespace

TEST_CASE("polyline: pieces know their ends, directions and what they are joined to") {
  const std::vector<Piece> open = pieces_of({{{1, 1}, {4, 5}, {4, 4}}});
  const std::vector<Piece> round = pieces_of({closed(square), {{7, 0}, {8, 0}}});
  REQUIRE(open.size() == 2);
  CHECK(open[0].length == 5);
  CHECK(open[0].tangent.x == Approx(0.6));
  CHECK(open[0].tangent.y == Approx(0.8));
  CHECK(open[0].normal.x == Approx(-0.8));
  CHECK(open[0].normal.y == Approx(0.6));
  CHECK(open[0].before == -1);
  CHECK(open[0].after == 1);
  CHECK(open[1].before == 0);
  CHECK(open[1].after == -1);
  REQUIRE(round.size() == 5);
  for (int k = 0; k < 4; ++k) {
    CHECK(round[static_cast<std::size_t>(k)].after == (k + 1) % 4);
    CHECK(round[static_cast<std::size_t>(k)].before == (k + 3) % 4);
  }
  CHECK(round[4].before == -1);  // of another line
  CHECK(round[4].after == -1);
}

TEST_CASE("polyline: a line is closed where it ends as it begins, or nearly") {
  CHECK(is_closed(closed(square)));
  CHECK_FALSE(is_closed(square));
  CHECK_FALSE(is_closed({{0, 0}, {0, 0}}));  // two points make no outline
  const Polyline nearly{{0, 0}, {1, 0}, {1, 1}, {0, 1e-7}};
  CHECK_FALSE(is_closed(nearly));
  CHECK(is_closed(nearly, 1e-6));
  CHECK(pieces_of({nearly}, 1e-6)[2].after == 0);
  CHECK(pieces_of({nearly})[2].after == -1);
}

TEST_CASE("polyline: lines of one point and pieces of no length") {
  CHECK(pieces_of({{{3, 0}}}).empty());
  const Piece none = piece_between({2, 1}, {2, 1});
  CHECK(none.length == 0);
  CHECK(none.tangent.x == 0);
  CHECK(distance({5, 5}, none) == 5);
  CHECK(distance({5, 5}, Polyline{{2, 1}}) == 5);
  CHECK(distance({-1.5, 0}, Polyline{{2, 0}}) == 3.5);  // a 1-D wall
  // 1-D: the place is the wall, its normal shows to the water.
  const Piece left{{2, 0}, {2, 0}, {}, {1, 0}}, right{{2, 0}, {2, 0}, {}, {-1, 0}};
  using V1 = Vec<double, 1>;
  CHECK(foot_on(left, V1{5}).off == 3);
  CHECK(foot_on(right, V1{5}).off == -3);
  NearestPiece found(4);
  found.look_at(0, left, V1{-1.5});
  CHECK(found.piece == 0);
  CHECK(found.foot.off == -3.5);
  found.look_at(1, Piece{{-1, 0}, {-1, 0}, {}, {-1, 0}}, V1{-1.5});
  CHECK(found.piece == 1);
  CHECK(found.foot.off == 0.5);
  NearestPiece short_sighted(3);
  short_sighted.look_at(0, left, V1{-1.5});
  CHECK(short_sighted.piece == -1);
}

TEST_CASE("polyline: feet and distances against many points of the piece") {
  test::Random random(3);
  for (int n = 0; n < 200; ++n) {
    const Point a{random(-1, 1), random(-1, 1)}, b{random(-1, 1), random(-1, 1)};
    const Point p{random(-2, 2), random(-2, 2)};
    const Piece piece = piece_between(a, b);
    constexpr int steps = 1000;
    double least = 1e300;
    for (int k = 0; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      least = std::min(least, std::hypot(p[0] - a[0] - s * (b[0] - a[0]), p[1] - a[1] - s * (b[1] - a[1])));
    }
    const double found = distance(p, piece), half_step = 0.5 * piece.length / steps;
    REQUIRE(found <= least * (1 + 1e-14));
    REQUIRE(least <= std::hypot(found, half_step) * (1 + 1e-14));  // some point is so near the foot
    const Foot<double> f = foot_on(piece, to_vec<2>(p));
    const V2 back = piece.a + f.along * piece.tangent + f.off * piece.normal;
    REQUIRE(std::hypot(back.x - p[0], back.y - p[1]) < 1e-14);
    // All lanes at once see the same.
    const Foot<Lane> lanes_foot = foot_on(piece, Vec<Lane, 2>{p[0], p[1]});
    REQUIRE(largest(lanes_foot.off) == Approx(f.off).margin(1e-15));
    REQUIRE(largest(lanes_foot.along) == Approx(f.along).margin(1e-15));
  }
}

TEST_CASE("polyline: turns are positive to the left, where a corner holds less water") {
  CHECK(turn({1, 0}, {0, 3}) == Approx(pi / 2));
  CHECK(turn({1, 0}, {0, -3}) == Approx(-pi / 2));
  CHECK(turn({2, 2}, {5, 5}) == 0);
  CHECK(turn({1, 0}, {1, std::sqrt(3.0)}) == Approx(pi / 3));
  CHECK(std::abs(turn({1, 0}, {-1, 0})) == Approx(pi));
  for (unsigned seed = 0; seed < 20; ++seed) {  // once round is one turn
    double sum = 0;
    const std::vector<Piece> pieces = pieces_of({closed(star(9, {0, 0}, seed))});
    for (const Piece& s : pieces) sum += turn(s.tangent, pieces[static_cast<std::size_t>(s.after)].tangent);
    CHECK(sum == Approx(2 * pi));
  }
}

TEST_CASE("polyline: the nearest piece tells the side, at sharp corners too, whatever the order of asking") {
  test::Random random(11);
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Polyline line = star(3 + static_cast<int>(seed % 9), {0, 0}, seed);
    const std::vector<Piece> pieces = pieces_of({closed(line)});
    for (int n = 0; n < 100; ++n) {
      const Point p{random(-1.5, 1.5), random(-1.5, 1.5)};
      const NearestPiece found = nearest(pieces, p, 5), other = nearest(pieces, p, 5, true);
      CAPTURE(seed, p[0], p[1]);
      REQUIRE(found.piece >= 0);
      REQUIRE(found.piece == other.piece);
      // Ties are as wide as 1e-9 reach^2.
      REQUIRE(std::sqrt(found.distance2) == Approx(distance(p, closed(line))).margin(2e-4));
      REQUIRE((found.foot.off > 0) == encloses(line, p));
    }
  }
}

TEST_CASE("polyline: of two pieces that share the nearest end the one counts whose line is farther away") {
  // Up to a sharp corner at the origin and back down, the water between the two.
  const std::vector<Piece> spike = pieces_of({{{0.2, -1}, {0, 0}, {-1, -1}}});
  const Point above{0.1, 0.5};  // the corner is nearest; 0.196 and 0.283 m behind the two lines
  for (const bool backwards : {false, true}) {
    const NearestPiece found = nearest(spike, above, 2, backwards);
    CHECK(found.piece == 1);
    CHECK(found.distance2 == Approx(0.26));
    CHECK(std::abs(found.foot.off) == Approx(0.4 / std::sqrt(2.0)));
  }
}

TEST_CASE("polyline: nothing is nearest beyond the reach or beside a free end") {
  const std::vector<Piece> wall = pieces_of({{{0, 0}, {2, 0}}}), bent = pieces_of({{{0, 0}, {2, 0}, {2, 2}}});
  CHECK(nearest(wall, {1, 0.5}, 0.4).piece == -1);
  CHECK(nearest(wall, {1, 0.5}, 0.6).piece == 0);
  CHECK(nearest(wall, {1, 0.5}, 0.6).foot.along == 1);
  CHECK(nearest(wall, {-0.1, 0.1}, 1).piece == -1);
  CHECK(nearest(wall, {2.1, 0.1}, 1).piece == -1);
  CHECK(nearest(bent, {2.1, -0.2}, 1).piece >= 0);  // a corner is no free end
  CHECK(nearest(bent, {2.1, 2.1}, 1).piece == -1);
  CHECK(nearest(wall, {std::nan(""), 0}, 1).piece == -1);
}

TEST_CASE("polyline: a polygon encloses its low edges and not its high ones: neighbours share no place") {
  CHECK(encloses(square, {0.5, 0}));
  CHECK(encloses(square, {0, 0.5}));
  CHECK(encloses(square, {0, 0}));
  CHECK_FALSE(encloses(square, {0.5, 1}));
  CHECK_FALSE(encloses(square, {1, 0.5}));
  CHECK_FALSE(encloses(square, {1, 1}));
  // Four triangles about the middle, of numbers that round nothing: each place lies in one of them.
  const Point middle{0.5, 0.5};
  int missed = 0;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j) {
      const Point p{i / 16.0, j / 16.0};
      int times = 0;
      for (std::size_t k = 0; k < 4; ++k) times += encloses({square[k], square[(k + 1) % 4], middle}, p);
      missed += times != 1;
    }
  CHECK(missed == 0);
}

TEST_CASE("polyline: what a concave polygon encloses, by the angles under which it is seen") {
  CHECK(encloses(notched, {2, 0.5}));
  CHECK(encloses(notched, {0.5, 2}));
  CHECK(encloses(notched, {3.5, 2}));
  CHECK_FALSE(encloses(notched, {2, 2}));  // in the notch
  CHECK_FALSE(encloses(notched, {5, 1}));
  test::Random random(8);
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Polyline line = star(8, {100, -50}, seed);
    for (int n = 0; n < 100; ++n) {
      const Point p{100 + random(-1.2, 1.2), -50 + random(-1.2, 1.2)};
      const bool inside = std::lround(windings(line, p)) == 1;
      REQUIRE(encloses(line, p) == inside);
      REQUIRE(encloses(closed(line), p) == inside);
      REQUIRE(encloses(reversed(line), p) == inside);
    }
  }
}

TEST_CASE("polyline: signed areas, counter-clockwise ones positive, far from the origin too") {
  CHECK(signed_area(square) == 1);
  CHECK(signed_area(closed(square)) == 1);
  CHECK(signed_area(reversed(square)) == -1);
  CHECK(signed_area(notched) == 8);  // 4 x 3 less the triangle of 4 x 2 / 2
  CHECK(signed_area({{0, 0}, {1, 1}}) == 0);
  CHECK(signed_area({{5e5, 4e6}, {5e5 + 3, 4e6}, {5e5 + 3, 4e6 + 2}, {5e5, 4e6 + 2}}) == 6);
}

TEST_CASE("polyline: crossings of a piece, of a polygon with itself, and bounds") {
  const Piece wall = piece_between({0, 0}, {2, 0});
  CHECK(crosses(wall, {1, -1}, {1, 1}));
  CHECK(crosses(wall, {1, 1}, {1, -1}));
  CHECK(crosses(wall, {-1, -1}, {1, 1}));  // at its end
  CHECK_FALSE(crosses(wall, {-1.1, -1}, {1, 1}));
  CHECK_FALSE(crosses(wall, {1, 1}, {1, 0.1}));
  CHECK_FALSE(crosses(wall, {1, 0}, {1, 1}));  // begins on it
  CHECK_FALSE(crosses_itself(notched));
  CHECK(crosses_itself({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
  const Box box = bounds_of({{3, 1}, {-2, 5}, {0, 0}});
  CHECK((box.xlo == -2 && box.xhi == 3 && box.ylo == 0 && box.yhi == 5));
  CHECK(distance({2, 2}, notched) == Approx(1 / std::sqrt(2.0)));
}
