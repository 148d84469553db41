// The finite-volume channel that validation tests compare with, against exact solutions.
#include <catch2/catch.hpp>

#include "src/reference/exact.hpp"
#include "tests/support/solve/channel.hpp"

using namespace freshet;

namespace {

// Mean relative error of the depth at t = 50 s.
double stoker_error(int cells) {
  const auto exact = stoker(10, 5, 1000, 9.81);
  test::ChannelFlow flow({0,
                          2000,
                          cells,
                          9.81,
                          0,
                          [](double) { return 0.0; },
                          [](double x) { return x < 1000 ? 10.0 : 5.0; },
                          {}});
  while (flow.time() < 50) flow.step(50);
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const double x = 2000 * (i + 0.5) / cells, depth = exact->at(x, 0, 50).depth;
    sum += std::abs(flow.depth(x) - depth) / depth;
  }
  return sum / cells;
}

}  // namespace

TEST_CASE("the reference channel converges to Stoker's dam break") {
  // Minmod and HLL across a shock: of first order, 0.85 leaves room for where the shock lies between cells.
  CHECK(stoker_error(800) <= 2e-3);
  CHECK(std::log2(stoker_error(200) / stoker_error(800)) / 2 >= 0.85);
}

TEST_CASE("the reference channel keeps a lake with a shore at rest and a slope at its normal depth") {
  const auto bed = [](double x) { return std::max(-1.0, 0.05 * (x - 15)); };
  test::ChannelFlow lake({0, 20, 100, 9.81, 0.01, bed, [&](double x) { return -bed(x); }, {}});
  while (lake.time() < 5) lake.step(5);
  CHECK(lake.level(2) == Approx(0).margin(1e-12));  // rounding
  CHECK(lake.level(12) == Approx(0).margin(1e-12));
  // Manning: u = sqrt(S) d^(2/3) / n far from the ends.
  test::ChannelFlow slope(
      {0, 2000, 400, 9.81, 0.03, [](double x) { return -1e-3 * x; }, [](double) { return 1.0; }, {}});
  while (slope.time() < 60) slope.step(60);
  const double u = std::sqrt(1e-3) / 0.03,
               relaxation = 1 / (9.81 * 0.03 * 0.03 * u);  // m/s, s: u tanh(t / relaxation) from rest
  CHECK(slope.depth(1000) == Approx(1).epsilon(1e-6));
  CHECK(slope.discharge(1000) ==
        Approx(u * std::tanh(60 / relaxation)).epsilon(2e-3));  // steps of 0.5 s, split in the friction
}
