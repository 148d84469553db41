// The pressure that gauges of an incompressible flow show: solved for from the velocities, without a step's
// impulses.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/support/run/flow.hpp"

using namespace freshet;

namespace {

std::vector<double> flow_pressures(const test::FlowRun& run) {
  const auto p = on_host(run.solver.flow_pressure());
  std::vector<double> all;
  for (int i = 0; i < run.solver.fields().size(); ++i) all.push_back(p(i));
  return all;
}

// Root mean square of the pressure's error over rho u0^2, of vortices with points n a side; means taken off.
double vortex_error(int n) {
  test::FlowRun run("fpm_taylor_green", {"water.spacing=" + std::to_string(1.0 / n)});
  run.run_to(0.1);
  const auto points = run.points();
  const auto p = flow_pressures(run);
  const double decay = std::exp(-16 * pi * pi * 1e-3 * run.clock.t);
  double sum = 0, mean = 0;
  std::vector<double> off;
  for (std::size_t i = 0; i < p.size(); ++i) {
    off.push_back(p[i] + 0.25 * decay * (std::cos(4 * pi * points[i].x) + std::cos(4 * pi * points[i].y)));
    mean += off.back() / static_cast<double>(p.size());
  }
  for (const double e : off) sum += (e - mean) * (e - mean);
  return std::sqrt(sum / static_cast<double>(p.size()));
}

}  // namespace

TEST_CASE("fpm flow pressure: still water has the weight of what is above it") {
  test::FlowRun run("fpm_still_box", {"water.disorder=0.2"});
  run.run_to(0.1);
  const auto points = run.points();
  const auto p = flow_pressures(run);
  double top = 0, most = 0;
  for (const auto& q : points) top = std::max(top, q.y);
  for (std::size_t i = 0; i < p.size(); ++i)
    most = std::max(most, std::abs(p[i] - 1000 * 9.81 * (top - points[i].y)));
  CHECK(most < 1e-7 * 1000 * 9.81 *
                   top);  // the equation's tolerance, 1e-9 of its right side, and what the water still moves
}

TEST_CASE("fpm flow pressure: vortices, second order") {
  const double coarse = vortex_error(20), fine = vortex_error(40);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.01);          // amplitude 0.25
  CHECK(coarse / fine > 2.5);  // velocities' slopes are of second order: 4, less where points have rearranged
}

TEST_CASE("fpm flow pressure: what a gauge asks for changes nothing in the run") {
  test::FlowRun with("fpm_lobovsky", {"water.spacing=0.03"}), without("fpm_lobovsky", {"water.spacing=0.03"});
  for (const double t : {0.1, 0.2, 0.3}) {
    with.run_to(t), without.run_to(t);
    CHECK(with.solver.read(with.scene.gauges).size() == with.scene.gauges.size());
  }
  with.run_to(0.35), without.run_to(0.35);
  const auto a = with.points(), b = without.points();
  REQUIRE(a.size() == b.size());
  bool same = true;
  for (std::size_t i = 0; i < a.size(); ++i)
    same = same && a[i].x == b[i].x && a[i].v == b[i].v && a[i].p == b[i].p;
  CHECK(same);
}
