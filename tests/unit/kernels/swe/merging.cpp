// Merging: who merges with whom, what is left; and the smoothing length that follows the masses.
#include <catch2/catch.hpp>

#include "kernels/swe/split/refinement.hpp"
#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;
using test::Grain;

namespace {

constexpr double huge = 1e300;

template <int D>
int merge(Cloud<D>& cloud, double area, double split_area = huge, const Field<int>& kind = {},
          double reach = 1) {
  cloud.solve(test::tight(D));
  swe::Refinement<D> refinement({},
                                swe::MergeOptions{PlacedValue(area, {}), PlacedValue(split_area, {}), reach},
                                {1.2, 9.81, 1, 1e300});
  return refinement.merge(cloud.bind(), cloud.fields.size(), kind, cloud.clusters, cloud.neighbours.view());
}

// Three light grains in a row, the first two the nearer ones, among heavy ones.
std::vector<Grain> row_of_three() {
  std::vector<Grain> grains = test::still_water(2, test::lattice(2, {-4, 4, -4, 4}, 1.0), 1.0, 2.0, 1.2);
  for (const double x : {0.0, 0.3, 0.7}) grains.push_back({{x, 0.1}, {x, 1}, 0.4, 2.0, 0.6});
  return grains;
}

std::vector<int> alive(const Cloud<2>& cloud) {
  std::vector<int> ids;
  for (int i = 0; i < cloud.fields.size(); ++i)
    if (cloud.bind().id(i) >= 64) ids.push_back(cloud.bind().id(i));
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

TEST_CASE("merging: the nearest two of three light grains merge, the heavy ones do not") {
  Cloud<2> cloud(row_of_three(), 1.0);
  REQUIRE(merge(cloud, 0.5) == 1);
  const auto left = alive(cloud);
  REQUIRE(left.size() == 2);
  CHECK((left[0] == 64 || left[0] == 65));
  CHECK(left[1] == 66);
  int gone = 0;
  for (int i = 0; i < cloud.fields.size(); ++i) gone += cloud.bind().id(i) < 0;
  CHECK(gone == 1);
}

TEST_CASE("merging: the new particle keeps mass, centre, momentum, area and the density at its place") {
  Cloud<2> cloud(row_of_three(), 1.0);
  cloud.solve(test::tight(2));
  const auto before = cloud.bind();
  struct Old {
    double m, x, u, rho, h;
  };
  std::vector<Old> old;
  for (int id : {64, 65})
    for (int i = 0; i < cloud.fields.size(); ++i)
      if (before.id(i) == id)
        old.push_back({before.m(i), before.x.x(i), before.v.x(i), before.rho(i), before.h(i)});
  REQUIRE(merge(cloud, 0.5) == 1);
  const auto p = cloud.bind();
  for (int i = 0; i < cloud.fields.size(); ++i) {
    if (p.id(i) != 64 && p.id(i) != 65) continue;
    CHECK(p.m(i) == Approx(0.8).epsilon(1e-15));
    CHECK(p.x.x(i) == Approx(0.15).epsilon(1e-14));
    CHECK(p.v.x(i) == Approx(0.15).epsilon(1e-14));
    CHECK(p.m(i) / p.rho(i) == Approx(old[0].m / old[0].rho + old[1].m / old[1].rho).epsilon(1e-12));
    double density = 0;
    for (const Old& o : old) density += o.m * test::printed_w(2, std::abs(o.x - 0.15) / o.h) / (o.h * o.h);
    CHECK(p.m(i) * test::printed_w(2, 0) / (p.h(i) * p.h(i)) == Approx(density).epsilon(1e-9));
    CHECK(p.kh(i) == Approx(p.rho(i) * p.h(i) * p.h(i)).epsilon(1e-14));
  }
}

TEST_CASE("merging: not over the area that splits, not with boundary particles, not too far apart") {
  Cloud<2> cloud(row_of_three(), 1.0);
  cloud.solve(test::tight(2));
  double pair = 0;
  for (int i = 0; i < cloud.fields.size(); ++i)
    if (cloud.bind().id(i) == 64 || cloud.bind().id(i) == 65) pair += cloud.bind().m(i) / cloud.bind().rho(i);
  CHECK(merge(cloud, 0.5, 0.5 * pair) == 0);
  Field<int> kind("kind", static_cast<std::size_t>(cloud.fields.size()));
  Kokkos::deep_copy(kind, 1);
  CHECK(merge(cloud, 0.5, huge, kind) == 0);
  CHECK(merge(cloud, 0.5, huge, {}, 0.05) == 0);
  CHECK(merge(cloud, 0.5) == 1);
}

TEST_CASE("merging: equal distances are settled by the ids") {
  std::vector<Grain> row;
  for (int k = 0; k < 7; ++k) row.push_back({{static_cast<double>(k), 0}, {0, 0}, 1.0, 1.0, 1.0});
  Cloud<1> cloud(row, 1.0);
  REQUIRE(merge(cloud, 10.0, huge, {}, 1.4) ==
          1);  // all distances are equal: 0-1 is the first pair; 2 wanted 1
  for (int i = 0; i < 7; ++i) CHECK((cloud.bind().id(i) < 0) == (cloud.bind().x.x(i) == 1));
}

TEST_CASE("relaxation: h goes to eta (m / depth)^(1/D) at the stated rate and stays there") {
  const int n = 6;
  auto water = test::still_water(2, test::lattice(2, {-n, n, -n, n}, 0.5), 0.5, 2.0, 1.2);
  for (Grain& g : water) g.h0 *= 2;  // kh four times too large
  Cloud<2> cloud(water, 0.5);
  cloud.solve(test::tight(2));
  const auto p = cloud.bind();
  const double target = 1.44 * 0.5, time = 2, dt = 0.01;
  int middle = 0;
  for (int i = 0; i < cloud.fields.size(); ++i)
    if (std::hypot(p.x.x(i), p.x.y(i)) < std::hypot(p.x.x(middle), p.x.y(middle))) middle = i;
  const double rate = std::sqrt(9.81 * p.rho(middle)) / (time * p.h(middle));
  const swe::Refinement<2> slow({}, {}, {1.2, 9.81, time, 1e300}), fast({}, {}, {1.2, 9.81, 0, 1e300});
  const double h0 = p.h0(middle);
  slow.relax(cloud.clusters, cloud.neighbours.view(), p, {}, dt);
  CHECK(p.kh(middle) == Approx(target * std::pow(4, std::exp(-rate * dt))).epsilon(1e-12));
  CHECK(p.h0(middle) / h0 ==
        Approx(std::sqrt(p.kh(middle) / (4 * target))).epsilon(1e-12));  // rho0 = kh / h0^2 stays
  fast.relax(cloud.clusters, cloud.neighbours.view(), p, {}, dt);
  for (int i = 0; i < cloud.fields.size(); ++i) CHECK(p.kh(i) == Approx(target).epsilon(1e-12));
}

TEST_CASE("relaxation: a light particle takes the h of a heavy one beside it, not of one far away") {
  std::vector<Grain> water{{{0, 0}, {0, 0}, 4.0, 1.0, 2.4}};
  for (const double x : {0.5, 4.0, 6.0}) water.push_back({{x, 0}, {0, 0}, 1.0, 1.0, 1.2});
  Cloud<2> cloud(water, 1.0);
  cloud.solve(test::tight(2));
  const auto p = cloud.bind();
  const double reach = 2 * cloud.of(0, "h");
  swe::Refinement<2>({}, {}, {1.2, 9.81, 0, 1e300}).relax(cloud.clusters, cloud.neighbours.view(), p, {}, 1);
  CHECK(cloud.of(0, "kh") == Approx(1.44 * 4));
  CHECK(cloud.of(1, "kh") == Approx(1.44 * 4 * (1 - 0.25 / (reach * reach))));
  CHECK(cloud.of(2, "kh") == Approx(1.44 * std::max(1.0, 4 * (1 - 16 / (reach * reach)))));
}
