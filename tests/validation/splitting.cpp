// What splitting does for thin, fast water: dam breaks over dry ground and the tsunami's run-up (Vacondio 2010, ch. 3, 4.6).
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "src/reference/exact.hpp"
#include "src/reference/radial.hpp"
#include "src/run/water_grid.hpp"
#include "tests/support/run_case.hpp"

using namespace freshet;

namespace {

struct Errors {
  double depth, front;  // relative L1 of the depth where the water moves; m, how far the front is off
};

// Depth on a raster that starts in the still water; in 2-D a band about the middle, where the sides cut no kernel. Not on
// particles: splitting puts more of them where the water is thin and so changes what a mean over particles weighs. The front
// is where the depth is 0.1 % of the still water's.
Errors dry_dam_errors(const std::string& name, const std::vector<std::string>& overrides) {
  const test::CaseRun run = test::finish_case(name, overrides);
  const Scene scene = test::read_case(name, overrides);
  const bool plane = scene.domain.dimension == 2;
  const CellGrid grid{501.25, plane ? 81.25 : 0.0, 2.5, plane ? 2.5 : 1.0, 600, plane ? 16 : 1};
  const auto depth = depth_on_grid(grid, *run.method);
  double difference = 0, sum = 0, front = 0, exact_front = 0;
  for (int i = 0; i < grid.nx; ++i) {
    const double exact = std::max(0.0, scene.compare.exact->at(grid.x(i), 0, scene.end_time).depth);
    double mean = 0;
    for (int j = 0; j < grid.ny; ++j) {
      const double here = depth[static_cast<std::size_t>(j * grid.nx + i)];
      difference += std::abs(here - exact);
      sum += exact;
      mean += here / grid.ny;
    }
    if (mean > 0.01) front = grid.x(i);
    if (exact > 0.01) exact_front = grid.x(i);
  }
  return {difference / sum, std::abs(front - exact_front)};
}

double outermost(const Fluid& fluid) {
  double most = 0;
  for (std::size_t k = 0; k < fluid.size(); ++k) most = std::max(most, std::hypot(fluid.x[k], fluid.y[k]));
  return most;
}

double mean_rmse(const Summary& s) {
  double sum = 0;
  for (const GaugeResult& g : s.gauges) sum += g.rmse;
  return sum / static_cast<double>(s.gauges.size());
}

}  // namespace

TEST_CASE("splitting halves the error of the dry dam break in depth and front") {
  // Vacondio 2010, 3.1 and 3.4.2: unsplit, particles drift apart along the flow only and no longer feel each other there.
  const std::string name = GENERATE("dam_break_dry", "dam_break_dry_strip");
  CAPTURE(name);
  const Errors whole = dry_dam_errors(name, {"split.area=1e9", "sph.h_cap=3"}), split = dry_dam_errors(name, {});
  CAPTURE(whole.depth, whole.front, split.depth, split.front);
  CHECK(whole.depth > 0.03);  // the defect is there
  CHECK(whole.front > 100);   // ten spacings
  CHECK(split.depth <= 0.5 * whole.depth);
  CHECK(split.front <= 0.5 * whole.front);
}

TEST_CASE("in one dimension the thin front needs a long h, not splitting") {
  // The defect of the unsplit channel is the cap of h at 3 h0: water cannot get thinner than a third of the first depth. The
  // default cap in 1-D is 30 h0, which lets the front come within the raster's and the kernel's width: two spacings and a half.
  const Errors capped = dry_dam_errors("dam_break_dry", {"split.area=1e9", "sph.h_cap=3"});
  const Errors whole = dry_dam_errors("dam_break_dry", {"split.area=1e9"});
  CAPTURE(capped.depth, capped.front, whole.depth, whole.front);
  CHECK(whole.depth <= 0.25 * capped.depth);
  CHECK(whole.front <= 25);
}

// On the raster: on particles the error is a mean over more of the thin water once that is split. The thesis' area of 2 halves
// the lag but for 2 % of it (131.7 of 258.5 m); 1.5 is its value for the channel.
TEST_CASE("splitting brings the circular dry dam break nearer to the reference, and halves the lag of its front") {
  const test::CaseRun whole = test::finish_case("dam_break_radial_dry");
  const test::CaseRun split = test::finish_case("dam_break_radial_dry", {"split.area=1.5", "split.velocity=linear"});
  CHECK(split.fluid.size() > 3 * whole.fluid.size());
  CHECK(split.summary.errors.grid_l2_rel < whole.summary.errors.grid_l2_rel);
  const double front = radial_dam_profile({10, 0, 1000}, 50, 9.81).front(0.01);
  const double lag_whole = front - outermost(whole.fluid), lag_split = front - outermost(split.fluid);  // m
  CAPTURE(lag_whole, lag_split);
  CHECK(std::abs(lag_split) <= 0.5 * lag_whole);
  CHECK(split.summary.mass.relative_error <= 1e-12);
}

TEST_CASE("okushiri with splitting beyond x = 2.5 m: run-up as measured, gauges no worse", "[okushiri][long][!mayfail]") {
  // May fail until splitting is quieter: 0.0795 to 0.083 m were measured for the 0.08 m, and the peaks of ch7 and the mean RMSE
  // are not always as good as unsplit ones (docs/accuracy.md). The bounds stay.
  if (!test::has_okushiri_data()) {
    std::printf("SKIPPED: okushiri: no data; call tools/data okushiri or set FRESHET_DATA\n");
    return;
  }
  // Twice the case's spacing, so that the split part has about the case's own: 7 particles to a cell of 0.0375 m.
  const std::vector<std::string> coarse{"water.spacing=0.0375"};
  const Summary whole = test::run_case("okushiri", coarse);
  const Summary split = test::run_case("okushiri", {coarse[0], "split.region=[{box=[2.5, -1.0, 6.0, 4.0], area=0.9}]"});
  REQUIRE(split.run_ups.size() == 3);
  CHECK(split.run_ups[0].highest >= 0.08);  // six runs of the experiment
  CHECK(split.run_ups[0].highest <= 0.10);
  // Missed: 3.52 mm against 3.40 (relax = 10: 3.50). The measured background before the wave makes 2.7 mm of either, and the
  // unsplit case itself has 3.44 at half the spacing: this mean does not tell a finer computation from a coarser one.
  CHECK(mean_rmse(split) <= mean_rmse(whole));
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(split.gauges[k].name);
    const double peak = split.gauges[k].measured_peak;
    CHECK(std::abs(split.gauges[k].peak - peak) <= std::abs(whole.gauges[k].peak - peak));
  }
  CHECK(split.mass.relative_error <= 1e-10);
}
