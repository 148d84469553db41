// The mesh preconditioner of scattered points: its symmetry, given points, free constants, and the same bits
// with any number of threads.
#include "kernels/linear/mesh/point_mesh.hpp"

#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"
#include "tests/support/watch/threads.hpp"

using namespace freshet;
using linear::PointMesh;

namespace {

// Disordered points in a unit square, every seventh of them given.
struct Meshed {
  FieldSet fields;
  RowOrder order;
  PointMesh mesh;
  linear::MeshWeights weights;

  Meshed(int n, bool periodic) : order(2, 1.0 / n, {0, 1, 0, 1}) {
    test::Random random(5);
    std::vector<Point> points;
    for (int k = 0; k < n * n; ++k)
      points.push_back({(k % n + 0.5 + 0.4 * random(-1, 1)) / n, (k / n + 0.5 + 0.4 * random(-1, 1)) / n});
    fields = test::point_fields(2, points);
    order.sort(fields);
    weights = {make("area"), make("weight"), make("held"), periodic};
    for (int i = 0; i < count(); ++i) {
      const bool given = !periodic && i % 7 == 0;
      weights.area(i) = 1 + 0.1 * (i % 3);
      weights.weight(i) = given ? 0 : 20 + i % 5;
      weights.held(i) = periodic ? 0 : 0.1;
    }
    const Period period = periodic ? Period{{0, 0}, {1, 1}} : Period{};
    mesh.build(order.rows(), {fields.real("x"), fields.real("y")}, count(), period, weights);
  }
  int count() const { return fields.size(); }
  Field<double> make(const char* name) { return fields.real(name, "1", Carry::no); }
};

double weighted(const Meshed& m, const Field<double>& a, const Field<double>& b) {
  double sum = 0;
  for (int i = 0; i < m.count(); ++i) sum += m.weights.weight(i) * a(i) * b(i);
  return sum;
}

}  // namespace

TEST_CASE(
    "point mesh: it adds a correction that is symmetric in the weights, nothing to given points and to "
    "constants that are free") {
  const bool periodic = GENERATE(false, true);
  Meshed m(21, periodic);
  const auto a = m.make("a"), b = m.make("b"), za = m.make("za"), zb = m.make("zb"), one = m.make("one");
  test::Random random(11);
  for (int i = 0; i < m.count(); ++i) {
    const bool given = m.weights.weight(i) == 0;
    a(i) = given ? 0 : random(-1, 1);
    b(i) = given ? 0 : random(-1, 1);
    one(i) = 3;
  }
  const auto correction = [&](const Field<double>& r, const Field<double>& z) {
    m.mesh(r, z);
    for (int i = 0; i < m.count(); ++i) z(i) -= r(i);
  };
  correction(a, za);
  correction(b, zb);
  const double there = weighted(m, a, zb), back = weighted(m, b, za);
  // The mean is taken off before the mesh, not behind it.
  const double mean_a = weighted(m, a, one) / weighted(m, one, one),
               mean_b = weighted(m, b, one) / weighted(m, one, one);
  const double off = periodic ? mean_a * weighted(m, one, zb) - mean_b * weighted(m, one, za) : 0;
  CHECK(there - back - off == Approx(0).margin(1e-10 * (std::abs(there) + 1)));
  for (int i = 0; i < m.count(); ++i)
    if (m.weights.weight(i) == 0) CHECK(za(i) == 0);
  if (!periodic) return;
  correction(one, za);
  for (int i = 0; i < m.count(); ++i) CHECK(std::abs(za(i)) <= 1e-10);
}

TEST_CASE("point mesh bits", "[.]") {
  Meshed m(60, true);
  const auto r = m.make("r"), z = m.make("z");
  for (int i = 0; i < m.count(); ++i) r(i) = std::sin(3.0 * i);
  m.mesh(r, z);
  test::say(z.data(), m.count());
}

TEST_CASE("point mesh: the same bits with one and two threads") {
  const std::string one = test::said("point mesh bits", 1);
  CHECK(one != "");
  CHECK(test::said("point mesh bits", 2) == one);
}
