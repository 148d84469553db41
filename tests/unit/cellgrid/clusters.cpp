// Cluster lists against all pairs.
#include "cellgrid/particles/clusters.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <limits>
#include <memory>

#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

constexpr double dx = 0.1;  // m
constexpr double margin = 0.05;
using Length = std::function<double(const Point&)>;  // h at a place

template <int D>
struct Listed {
  FieldSet fields;
  RowOrder order;
  ClusterSet clusters;
  NeighbourList list;
  std::vector<Point> points;  // in the order of the list
  std::vector<double> h;

  Listed(const std::vector<Point>& unsorted, const Length& length, int slab = 96)
      : fields(test::point_fields(D, unsorted)), order(D, dx, test::wide(dx)), list(slab) {
    order.sort(fields);
    for (int i = 0; i < fields.size(); ++i)
      fields.real("h")(i) = length({fields.real("x")(i), D == 2 ? fields.real("y")(i) : 0.0});
    build();
  }
  void build() {
    clusters.cut(order.rows());
    const auto length = fields.real("h");
    order.measure_reach(fields, length, 2 * (1 + margin));
    const auto x = fields.vector<D>("x", "y");
    list.build<D>(clusters, {x, length, order.rows(), x, length, 2.0, margin});
    points.clear(), h.clear();
    for (int i = 0; i < fields.size(); ++i) {
      const Vec<double, D> p = at(x, i);
      if constexpr (D == 1) points.push_back({p.x, 0});
      else points.push_back({p.x, p.y});
      h.push_back(length(i));
    }
  }
  const Point& point(int i) const { return points[static_cast<size_t>(i)]; }
};

double distance(const Point& a, const Point& b) {
  const double dx_ab = a[0] - b[0], dy_ab = a[1] - b[1];
  return std::sqrt(dx_ab * dx_ab + dy_ab * dy_ab);
}

// r / max(h_i, h_j)
template <int D>
double distance(const Listed<D>& s, int i, int j) {
  return distance(s.point(i), s.point(j)) /
         std::max(s.h[static_cast<size_t>(i)], s.h[static_cast<size_t>(j)]);
}

struct Faults {
  long missing = 0, twice = 0, needless = 0, uncovered = 0, mixed_rows = 0;
  long sum() const { return missing + twice + needless + uncovered + mixed_rows; }
};

// One cluster against all particles: `times` counts how often each is listed.
template <int D>
void check_cluster(const Listed<D>& s, const Lanes& me, const std::vector<int>& times, Faults& faults) {
  const double sure = 2 * (1 + margin);
  for (int j = 0; j < s.fields.size(); ++j) {
    double nearest = 1e300;
    for (int l = 0; l < me.count; ++l) nearest = std::min(nearest, distance(s, me.particle(l), j));
    const int count = times[static_cast<size_t>(j)];
    faults.missing += nearest < sure * (1 - 1e-12) && count == 0;  // 1e-12: both sides round
    faults.needless += nearest > sure * (1 + 1e-12) && count > 0;
    faults.twice += count > 1;
  }
}

// The particles of a part: lanes beyond the last particle repeat it.
Lanes part_of(const Lanes& me, int part) {
  const int width = lanes / parts_of_cluster, first = part * width, count = std::min(me.count - first, width);
  return count > 0 ? Lanes{me.first + first, count} : Lanes{me.first + me.count - 1, 1};
}

// The lists of the parts against all particles, too. Where lists are longer than a place can say (255) a part
// has the whole list.
template <int D>
void check_parts(const Listed<D>& s, int c, Faults& faults) {
  std::vector<int> times;
  const NeighbourView view = s.list.view();
  const bool own_lists = parts_of_cluster == 1 || view.part_length.extent(0) > 0;
  CHECK(own_lists == (parts_of_cluster == 1 || view.list.extent_int(1) <= 256));
  for (int part = 0; part < parts_of_cluster; ++part) {
    times.assign(static_cast<size_t>(s.fields.size()), 0);
    const NearList near = view.of(c, part);
    for (int k = 0; k < near.n; ++k) ++times[static_cast<size_t>(near[k])];
    check_cluster(s, own_lists ? part_of(s.clusters(c), part) : s.clusters(c), times, faults);
  }
}

template <int D>
Faults faults_of(const Listed<D>& s) {
  Faults faults;
  std::vector<int> covered(static_cast<size_t>(s.fields.size())), times;
  for (int c = 0; c < s.clusters.size(); ++c) {
    const Lanes me = s.clusters(c);
    for (int l = 0; l < me.count; ++l) {
      ++covered[static_cast<size_t>(me.particle(l))];
      if (D == 2)
        faults.mixed_rows +=
            s.order.rows().row_of(s.point(me.particle(l))[1]) != s.order.rows().row_of(s.point(me.first)[1]);
    }
    times.assign(covered.size(), 0);
    s.list.view().for_each(c, [&](int j) { ++times[static_cast<size_t>(j)]; });
    check_cluster(s, me, times, faults);
    check_parts(s, c, faults);
  }
  for (const int count : covered) faults.uncovered += count != 1;
  return faults;
}

template <int D>
void require_faultless(const Listed<D>& s) {
  const Faults f = faults_of(s);
  INFO("D " << D << ": missing " << f.missing << ", twice " << f.twice << ", needless " << f.needless
            << ", uncovered " << f.uncovered << ", mixed rows " << f.mixed_rows);
  CHECK(f.sum() == 0);
}

Length constant(double h) {
  return [h](const Point&) { return h; };
}

// The same scene in both dimensions.
void check(const std::function<std::vector<Point>(int)>& points, const Length& length) {
  require_faultless(Listed<1>(points(1), length));
  require_faultless(Listed<2>(points(2), length));
}

}  // namespace

TEST_CASE("clusters: random particles") {
  check([](int d) { return test::random_points(d, 1500, d == 2 ? 2.0 : 60.0, 1); }, constant(1.2 * dx));
}

TEST_CASE("clusters: a lattice, also one whose points lie on the borders of bins and rows") {
  check([](int d) { return test::lattice(d, {0, 40, 0, 37}, dx); }, constant(1.2 * dx));
  check(
      [](int d) {
        auto points = test::lattice(d, {-20, 20, -18, 18}, dx);
        for (Point& p : points) p = {p[0] - 0.5 * dx, d == 2 ? p[1] - 0.5 * dx : 0};
        return points;
      },
      constant(dx));  // here 2 h is a distance that occurs
}

TEST_CASE("clusters: strongly varying h") {
  const Length front = [](const Point& p) { return p[0] > 0.2 ? 6 * dx : 1.2 * dx; };
  check([](int d) { return test::random_points(d, 1500, d == 2 ? 2.0 : 40.0, 2); }, front);
  auto random = std::make_shared<test::Random>(7);
  const Length anyhow = [random](const Point&) { return dx * (*random)(0.5, 2.5); };
  check([](int d) { return test::random_points(d, 1500, d == 2 ? 2.0 : 40.0, 3); }, anyhow);
  const Length lone = [](const Point& p) {
    return std::abs(p[0] - 1) < 0.03 ? 20 * dx : 0.3 * dx;
  };  // one long arm
  check([](int d) { return test::random_points(d, 1000, d == 2 ? 2.0 : 40.0, 4); }, lone);
}

TEST_CASE("clusters: two thousand particles on nearly one point overflow the slabs, and no pair is lost") {
  auto crowd = [](int d) {
    auto points = test::random_points(d, 2000, 1e-3 * dx, 5);
    const auto around = test::random_points(d, 500, 1.0, 6);
    points.insert(points.end(), around.begin(), around.end());
    return points;
  };
  check(crowd, constant(1.2 * dx));
  const Listed<2> s(crowd(2), constant(1.2 * dx));
  CHECK(s.list.mean_length(s.clusters) > 1500);
}

TEST_CASE("clusters: the first slab may be as short as one") {
  const auto points = test::random_points(2, 300, 0.7, 8);
  require_faultless(Listed<2>(points, constant(1.2 * dx), 1));
}

TEST_CASE("clusters: no particle and one particle") {
  const Listed<2> none({}, constant(dx));
  CHECK(none.clusters.size() == 0);
  CHECK(none.list.mean_length(none.clusters) == 0);
  check([](int d) { return std::vector<Point>{{5.0, d == 2 ? -3.0 : 0.0}}; }, constant(1.2 * dx));
}

TEST_CASE("clusters: particles along the rim of a box") {
  check(
      [](int d) {
        std::vector<Point> rim;
        for (int k = 0; k <= 100; ++k) {
          const double s = 0.02 * k;
          rim.push_back({s, 0});
          if (d == 2)
            rim.insert(rim.end(), {{s, 2}, {0, s}, {2, s}});  // corners twice: particles on one point
        }
        return rim;
      },
      constant(1.2 * dx));
}

TEST_CASE("clusters: two islands far apart") {
  check(
      [](int d) {
        auto points = test::random_points(d, 500, 0.8, 9);
        const auto other = test::random_points(d, 500, 0.8, 10, {1e5 * dx, d == 2 ? -2e5 * dx : 0});
        points.insert(points.end(), other.begin(), other.end());
        return points;
      },
      constant(1.2 * dx));
}

TEST_CASE("clusters: a list made again after particles moved and h grew") {
  Listed<2> s(test::random_points(2, 1200, 1.8, 11), constant(1.2 * dx));
  test::Random random(12);
  for (int i = 0; i < s.fields.size(); ++i) s.fields.real("x")(i) += random(-dx, dx);
  s.order.sort(s.fields);
  for (int i = 0; i < s.fields.size(); ++i) s.fields.real("h")(i) *= random(1, 3);
  s.build();
  require_faultless(s);
}

TEST_CASE("clusters: sources of another set, as for walls") {
  Listed<2> sources(test::random_points(2, 700, 2.0, 13), [](const Point&) { return 0.0; });
  Listed<2> targets(test::random_points(2, 900, 1.5, 14),
                    [](const Point& p) { return p[1] > 0 ? 3 * dx : dx; });
  NeighbourList near(4);
  near.build<2>(targets.clusters,
                {targets.fields.vector<2>("x", "y"), targets.fields.real("h"), sources.order.rows(),
                 sources.fields.vector<2>("x", "y"), sources.fields.real("h"), 1.0, margin});
  long wrong = 0;
  for (int c = 0; c < targets.clusters.size(); ++c) {
    std::vector<int> times(700);
    near.view().for_each(c, [&](int k) { ++times[static_cast<size_t>(k)]; });
    for (int k = 0; k < 700; ++k) {
      bool wanted = false;
      for (int l = 0; l < targets.clusters(c).count; ++l) {
        const int i = targets.clusters(c).particle(l);
        wanted = wanted || distance(targets.point(i), sources.point(k)) <
                               (1 + margin) * targets.h[static_cast<size_t>(i)];
      }
      wrong += times[static_cast<size_t>(k)] != wanted;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("clusters: a position that is not a number leaves the others' lists alone") {
  auto points = test::random_points(2, 600, 1.2, 15);
  points[77][0] = points[200][1] = std::numeric_limits<double>::quiet_NaN();
  const Listed<2> s(points, constant(1.2 * dx));
  long missing = 0;
  for (int c = 0; c < s.clusters.size(); ++c) {
    const Lanes me = s.clusters(c);
    bool lost = false;
    for (int l = 0; l < me.count; ++l)
      lost = lost || !std::isfinite(s.point(me.particle(l))[0] + s.point(me.particle(l))[1]);
    if (lost) continue;
    std::vector<int> times(600);
    s.list.view().for_each(c, [&](int j) { ++times[static_cast<size_t>(j)]; });
    for (int l = 0; l < me.count; ++l)
      for (int j = 0; j < 600; ++j)
        missing += distance(s, me.particle(l), j) < 2 && times[static_cast<size_t>(j)] == 0;
  }
  CHECK(missing == 0);
}
