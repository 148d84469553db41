// Stored pairs against all pairs, and the matrix product over them against a dense one.
#include "cellgrid/particles/pairs.hpp"

#include <catch2/catch.hpp>

#include <vector>

#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

constexpr double dx = 0.1;      // m
constexpr double factor = 2.0;  // support / h

// Points sorted into rows and paired; h grows along x by half.
template <int D>
struct Paired {
  FieldSet fields;
  RowOrder order{D, dx, test::wide(dx)};
  Pairs pairs;

  explicit Paired(const std::vector<Point>& points) : fields(test::point_fields(D, points)) {
    order.sort(fields);
    const Field<double> h = fields.real("h"), x = fields.real("x");
    for (int i = 0; i < fields.size(); ++i) h(i) = 1.3 * dx * (1 + 0.25 * x(i));
    order.measure_reach(fields, h, factor);
    pairs.build<D>(fields.size(), {order.rows(), fields.vector<D>("x", "y"), h, factor});
  }
  double distance(int i, int j) const {
    const auto x = fields.vector<D>("x", "y");
    const Vec<double, D> d = at(x, i) - at(x, j);
    return std::sqrt(dot(d, d));
  }
  bool paired(int i, int j) const {
    const Field<double> h = fields.real("h");
    return i != j && distance(i, j) < 0.5 * factor * (h(i) + h(j));
  }
};

// times[i][j]: how often j stands in the row of i, itself (padding) left out.
std::vector<std::vector<int>> counted(const PairView& view) {
  const auto n = static_cast<std::size_t>(view.particles);
  std::vector<std::vector<int>> times(n, std::vector<int>(n, 0));
  for (int s = 0; s < view.slices(); ++s)
    view.for_each(s, [&](int e, PairIndex) {
      for (int l = 0; l < lanes; ++l) {
        const int i = view(s).particle(l), j = view.j(PairView::at(e, l));
        if (i != j) ++times[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      }
    });
  return times;
}

template <int D>
void check_pairs(const std::vector<Point>& points) {
  const Paired<D> p(points);
  const auto times = counted(p.pairs.view());
  long wrong = 0;
  for (int i = 0; i < p.fields.size(); ++i)
    for (int j = 0; j < p.fields.size(); ++j)
      wrong += times[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] != (p.paired(i, j) ? 1 : 0);
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("stored pairs are exactly those within the mean support", "[pairs]") {
  check_pairs<1>(test::random_points(1, 203, 1.0, 1));
  check_pairs<2>(test::random_points(2, 1003, 1.0, 2));
  check_pairs<2>(test::lattice(2, {0, 17, 0, 13}, dx));
  check_pairs<2>({{0, 0}});  // one particle: every entry is padding, if there is any
}

TEST_CASE("the weighted sum over stored pairs equals the dense product", "[pairs]") {
  const Paired<2> p(test::random_points(2, 501, 0.8, 3));
  const PairView view = p.pairs.view();
  const Field<double> a = p.pairs.coefficient("a"), y("y", 501);
  const auto coefficient = [&](int i, int j) { return i == j ? 0.0 : std::cos(3.0 * p.distance(i, j)); };
  const auto x = p.fields.real("x");
  for (int s = 0; s < view.slices(); ++s)
    view.for_each(s, [&](int e, PairIndex) {
      for (int l = 0; l < lanes; ++l)
        a(PairView::at(e, l)) = coefficient(view(s).particle(l), view.j(PairView::at(e, l)));
    });
  for (int s = 0; s < view.slices(); ++s) view(s).store(y, view.weighted_sum(s, a, x));
  double largest = 0;
  for (int i = 0; i < 501; ++i) {
    double sum = 0;
    for (int j = 0; j < 501; ++j)
      if (p.paired(i, j)) sum += coefficient(i, j) * x(j);
    largest = std::max(largest, std::abs(sum - y(i)));
  }
  CHECK(largest < 1e-13);  // some 100 terms of at most 1 in two orders
}
