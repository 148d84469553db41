// The order of particles by row, bin and id.
#include "cellgrid/particles/order.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <set>

#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

constexpr double dx = 0.1;  // m

struct Sorted {
  FieldSet fields;
  RowOrder order;
  Sorted(int dimension, const std::vector<Point>& points, const std::vector<int>& ids = {})
      : fields(test::point_fields(dimension, points, ids)), order(dimension, dx, test::wide(dx)) {
    order.sort(fields);
  }
  Sorted(int dimension, const std::vector<Point>& points, const Box& domain)
      : fields(test::point_fields(dimension, points)), order(dimension, dx, domain) {
    order.sort(fields);
  }
  int row(int i) const { return fields.has("y") ? order.rows().row_of(fields.real("y")(i)) : 0; }
  int bin(int i) const { return order.rows().bin_of(fields.real("x")(i)); }
  long key(int i) const { return static_cast<long>(row(i)) * order.rows().bins + bin(i); }
  std::vector<int> ids() const {
    const auto id = fields.integer("id");
    return {id.data(), id.data() + fields.size()};
  }
};

// Particles that stand before one of a lower cell, or of the same cell and a lower id.
int out_of_order(const Sorted& s) {
  int wrong = 0;
  const auto id = s.ids();
  for (int i = 0; i + 1 < s.fields.size(); ++i) {
    const long here = s.key(i), next = s.key(i + 1);
    wrong += next < here || (next == here && id[static_cast<size_t>(i + 1)] < id[static_cast<size_t>(i)]);
  }
  return wrong;
}

// Particles that are not where the table of cells says.
int misplaced(const Sorted& s) {
  const Rows& rows = s.order.rows();
  int wrong = 0;
  for (int i = 0; i < s.fields.size(); ++i) {
    const int r = s.row(i), b = s.bin(i);
    wrong +=
        i < rows.begin(r, b) || i >= rows.end(r, b) || i < rows.row_begin(r) || i >= rows.row_begin(r + 1);
  }
  return wrong + (rows.begin(0, 0) != 0) + (rows.row_begin(rows.rows) != s.fields.size());
}

// Particles whose position is no longer the one of their id.
int strayed(const Sorted& s, const std::vector<Point>& points) {
  int wrong = 0;
  const auto id = s.ids();
  for (int i = 0; i < s.fields.size(); ++i) {
    const Point& p = points[static_cast<size_t>(id[static_cast<size_t>(i)])];
    wrong += s.fields.real("x")(i) != p[0] || (s.fields.has("y") && s.fields.real("y")(i) != p[1]);
  }
  return wrong;
}

void require_sorted(const Sorted& s, const std::vector<Point>& points) {
  const auto ids = s.ids();
  CHECK(ids.size() == points.size());
  CHECK(std::set<int>(ids.begin(), ids.end()).size() == points.size());
  CHECK(strayed(s, points) == 0);
  CHECK(out_of_order(s) == 0);
  CHECK(misplaced(s) == 0);
}

// Entries of the tables that the order keeps.
int blocks(const Rows& rows) { return rows.rows * rows.columns; }
int cells(const Rows& rows) { return rows.block(blocks(rows)); }

}  // namespace

TEST_CASE("order: a permutation, rows and bins ascending, ties by id") {
  const int dimension = GENERATE(1, 2);
  CAPTURE(dimension);
  const auto random = test::random_points(dimension, 3000, dimension == 2 ? 2.7 : 100.0, 5);
  require_sorted(Sorted(dimension, random), random);
  const auto regular = test::lattice(dimension, {-20, 30, 7, 40}, dx);
  require_sorted(Sorted(dimension, regular), regular);
  // All on a few points: every bin holds many, and only the id orders them.
  std::vector<Point> crowded;
  for (int i = 0; i < 500; ++i) crowded.push_back({0.3 * (i % 3), dimension == 2 ? 0.5 * (i % 2) : 0});
  require_sorted(Sorted(dimension, crowded), crowded);
  CHECK(cells(Sorted(dimension, random).order.rows()) > 100);  // the grid does resolve the cloud
}

TEST_CASE("order: does not depend on the order at the start") {
  const int dimension = GENERATE(1, 2);
  const auto points = test::random_points(dimension, 2000, 1.0, 11);  // dense: several particles in most bins
  const Sorted reference(dimension, points);
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto ids = test::shuffled(test::numbers(2000), seed);
    std::vector<Point> moved;
    for (const int id : ids) moved.push_back(points[static_cast<size_t>(id)]);
    CHECK((Sorted(dimension, moved, ids).ids() == reference.ids()));
  }
}

TEST_CASE("order: sorting again changes nothing") {
  Sorted s(2, test::random_points(2, 1000, 1.5, 3));
  const auto before = s.ids();
  s.order.sort(s.fields);
  CHECK((s.ids() == before));
}

TEST_CASE("order: particles with a negative id are dropped") {
  const auto points = test::random_points(2, 900, 1.0, 21);
  auto ids = test::numbers(900);
  for (size_t k = 0; k < ids.size(); k += 3) ids[k] = -1 - ids[k];
  const Sorted s(2, points, ids);
  REQUIRE(s.fields.size() == 600);
  CHECK(strayed(s, points) == 0);
  CHECK(out_of_order(s) == 0);
  CHECK(misplaced(s) == 0);
  Sorted none(2, points, std::vector<int>(900, -1));
  CHECK(none.fields.size() == 0);
}

TEST_CASE("order: a dropped particle far away does not stretch the grid") {
  auto points = test::random_points(2, 400, 1.0, 22);
  auto ids = test::numbers(400);
  const int before = cells(Sorted(2, points, ids).order.rows());
  points.push_back({1e7, -1e7});
  ids.push_back(-1);
  CHECK(cells(Sorted(2, points, ids).order.rows()) == before);
}

TEST_CASE("order: a stray particle changes nobody else's row, bin or place in the order") {
  const int dimension = GENERATE(1, 2);
  const double far = GENERATE(-190.0, 150.0, 1e7);  // m; the domain reaches to 200
  const auto points = test::random_points(dimension, 3000, 2.0, 23);
  auto with = points;
  with.push_back({far, dimension == 2 ? -far : 0});
  const Sorted alone(dimension, points), accompanied(dimension, with);
  std::vector<int> ids = accompanied.ids();
  ids.erase(std::remove(ids.begin(), ids.end(), 3000), ids.end());
  CHECK((ids == alone.ids()));
  // Who shares a row or a bin with whom.
  const auto key = [](const Sorted& s, const Point& p) {
    const Rows& r = s.order.rows();
    return std::pair(r.first_row + r.row_of(p[1]), r.first_bin + r.bin_of(p[0]));
  };
  int differ = 0;
  for (const Point& p : points) differ += key(alone, p) != key(accompanied, p);
  CHECK(differ == 0);
}

TEST_CASE("order: rows and bins stay where they are when the water moves") {
  const auto points = test::random_points(2, 2000, 1.0, 24);
  std::vector<Point> right;  // the right half alone: another window of the same grid
  for (const Point& p : points)
    if (p[0] > 0.1 && p[1] > -0.3) right.push_back(p);
  const Sorted all(2, points), half(2, right);
  const Rows &a = all.order.rows(), &b = half.order.rows();
  int differ = 0;
  for (const Point& p : right)
    differ += a.first_row + a.row_of(p[1]) != b.first_row + b.row_of(p[1]) ||
              a.first_bin + a.bin_of(p[0]) != b.first_bin + b.bin_of(p[0]);
  CHECK(differ == 0);
  CHECK(b.first_row > a.first_row);
  CHECK(b.first_bin > a.first_bin);
  CHECK(b.x0 == b.x_origin + b.first_bin * b.bin_width);
}

TEST_CASE("order: a period has as many cells as fit in, wherever its points lie") {
  // Points at both ends of [0, 3): 60 bins of 0.05, and no 61st by rounding.
  const double end = std::nextafter(3.0, 0.0);
  const Sorted s(2, {{0, 0}, {end, end}, {1.5, 1.5}}, Box{0, 3, 0, 3});
  CHECK(s.order.rows().bins == 60);
  CHECK(s.order.rows().rows == 15);
  CHECK(s.order.rows().x0 == 0.0);
  CHECK(misplaced(s) == 0);
}

TEST_CASE("order: no particle, one particle") {
  const int dimension = GENERATE(1, 2);
  require_sorted(Sorted(dimension, {}), {});
  require_sorted(Sorted(dimension, {{3.0, dimension == 2 ? -4.0 : 0.0}}),
                 {{3.0, dimension == 2 ? -4.0 : 0.0}});
}

TEST_CASE("order: a position that is not a number loses no particle") {
  const int dimension = GENERATE(1, 2);
  auto points = test::random_points(dimension, 500, 1.0, 31);
  const double lost = std::numeric_limits<double>::quiet_NaN();
  points[17][0] = lost;
  points[402][0] = lost;
  if (dimension == 2) points[402][1] = points[33][1] = lost;
  const Sorted s(dimension, points);
  const auto ids = s.ids();
  CHECK(std::set<int>(ids.begin(), ids.end()).size() == 500);
  CHECK(misplaced(s) == 0);
  CHECK(out_of_order(s) == 0);
}

TEST_CASE("order: a position that becomes infinite keeps the grid that was") {
  auto points = test::random_points(2, 500, 1.0, 32);
  Sorted s(2, points);
  const int before = blocks(s.order.rows());
  s.fields.real("x")(100) = std::numeric_limits<double>::infinity();
  s.fields.real("y")(200) = -std::numeric_limits<double>::infinity();
  s.order.sort(s.fields);
  CHECK(s.fields.size() == 500);
  CHECK(blocks(s.order.rows()) == before);
  CHECK(misplaced(s) == 0);
}

TEST_CASE("order: a stray particle does not make a huge grid") {
  const int dimension = GENERATE(1, 2);
  const double far = GENERATE(1e3, 1e6, 1e12, 1e200);
  const int along = GENERATE(0, 1, 2);  // in x, in y, in both
  auto points = test::random_points(dimension, 1000, 1.5, 41);
  if (along != 1) points[500][0] = far;
  if (along != 0 && dimension == 2) points[500][1] = -far;
  const Sorted s(dimension, points);
  // The domain of 4000 x 4000 spacings has 2000 rows of 250 blocks, and one of each where its ends fall on
  // cells'.
  CHECK(blocks(s.order.rows()) <= 2001 * 251);
  require_sorted(s, points);
  // A domain of 1e14 square spacings gets wider cells, whatever the points.
  const Sorted wide(dimension, points, Box{-1e6, 1e6, -1e6, 1e6});
  CHECK(blocks(wide.order.rows()) <= 3.1e7);
  require_sorted(wide, points);
}

// Runs of particles within a distance of a place, as a list and by looking at every particle.
void check_runs(const Sorted& s, const Point& at, double distance) {
  std::vector<int> found(static_cast<size_t>(s.fields.size()), 0);
  s.order.rows().for_each_run(at[0], at[0], at[1], at[1], distance, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) ++found[static_cast<size_t>(i)];
  });
  int missed = 0, twice = 0;
  for (int i = 0; i < s.fields.size(); ++i) {
    const double r = std::hypot(s.fields.real("x")(i) - at[0], s.fields.real("y")(i) - at[1]);
    missed += r <= distance && found[static_cast<size_t>(i)] == 0;
    twice += found[static_cast<size_t>(i)] > 1;
  }
  CHECK(missed == 0);
  CHECK(twice == 0);
}

TEST_CASE(
    "order: two ponds far apart need no wider bins and hardly more memory, and every place finds its "
    "particles") {
  auto points = test::random_points(2, 1500, 2.0, 61, {0, 0});
  const auto other = test::random_points(2, 1500, 2.0, 62, {70, 30});  // 160 times the area of both
  points.insert(points.end(), other.begin(), other.end());
  const Sorted s(2, points);
  require_sorted(s, points);
  CHECK(s.order.rows().bin_width == 0.5 * dx);
  CHECK(s.order.rows().row_height == 2 * dx);
  CHECK(cells(s.order.rows()) <=
        2 * 21 * 4 * Rows::block_bins);  // two ponds of 21 rows, each across four blocks at most
  test::Random random(63);
  for (int k = 0; k < 40; ++k)
    check_runs(s, {random(-3, 73), random(-3, 33)}, random(0.1, 2));  // dry places too
  for (int k = 0; k < 40; ++k) check_runs(s, points[static_cast<size_t>(70 * k)], random(0.1, 2));
}

TEST_CASE("order: the largest h near a place is never too small, and far ones do not count") {
  const auto points = test::random_points(2, 4000, 3.0, 51);
  Sorted s(2, points);
  const auto x = s.fields.real("x"), y = s.fields.real("y"), h = s.fields.real("h");
  test::Random random(52);
  for (int i = 0; i < s.fields.size(); ++i)
    h(i) = x(i) > 0 ? 5 * dx : dx * random(0.8, 1.2);  // a front at x = 0
  s.order.measure_reach(s.fields, h, 2.1);
  int wrong = 0;
  for (int i = 0; i < s.fields.size(); i += 7) {
    double needed = 0;
    for (int j = 0; j < s.fields.size(); ++j)
      if (std::hypot(x(i) - x(j), y(i) - y(j)) < 2.1 * h(j)) needed = std::max(needed, h(j));
    wrong += s.order.rows().largest_h(x(i), x(i), y(i), y(i)) < needed;
  }
  CHECK(wrong == 0);
  // Tiles are 2.1 x 5 dx wide: two tiles to the left of the front its h is forgotten.
  CHECK(s.order.rows().largest_h(-2.9, -2.9, 0, 0) <= 1.2 * dx);
}
