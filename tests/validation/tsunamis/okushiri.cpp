// The Okushiri (Monai valley) experiment: three gauges, run-up, mass. The times and levels that the model is
// held to are the measured ones, with no offset removed.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

#include "tests/support/run/run_case.hpp"
#include "tests/support/run/scenes.hpp"

using namespace freshet;

namespace {

struct Measured {
  const char* name;
  double peak, arrival;  // m; s, first crossing of 1 cm after 10 s
};
constexpr Measured gauges[] = {{"ch5", 0.0369, 15.50}, {"ch7", 0.0390, 15.10}, {"ch9", 0.0454, 15.30}};

bool skipped() {
  if (test::has_okushiri_data()) return false;
  std::printf("SKIPPED: okushiri: no data; call tools/data okushiri or set FRESHET_DATA\n");
  return true;
}

}  // namespace

TEST_CASE("okushiri: gauges, run-up and mass", "[okushiri][slow]") {
  if (skipped()) return;
  const test::Results s = test::run_case("okushiri");
  REQUIRE(s.gauges.size() == 3);
  // Of this the measured background before the wave, absent from the incident wave, makes about 2.7 mm in any
  // model.
  CHECK(test::mean_rmse(s) <= 3.7e-3);
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(gauges[k].name);
    CHECK(s.gauges[k].name == gauges[k].name);
    // Measured peaks ride on undular (dispersive) oscillations that shallow water theory lacks: mesh codes
    // stay within 5-10 %.
    CHECK(s.gauges[k].peak == Approx(gauges[k].peak).epsilon(0.10));
    CHECK(s.gauges[k].arrival == Approx(gauges[k].arrival).margin(0.30));
  }
  REQUIRE(!s.run_ups.empty());
  CHECK(s.run_ups[0].highest >=
        0.075);  // measured 0.08 to 0.10 m over six runs, widened by half a grid cell of the bed
  CHECK(s.run_ups[0].waterline <= 0.11);
  CHECK(s.mass.relative_error <= 1e-10);  // only sums can err: particles carry their mass unchanged
  CHECK(s.mass.flux_error <=
        5e-3);  // particles cross the line one by one; their parts across it are accounted for
}

TEST_CASE("okushiri: a bed rougher than the laboratory's gives clearly lower peaks", "[okushiri][long]") {
  if (skipped()) return;
  // RMSE alone would pass a ten times too rough bed; the peaks must not: they leave the 10 % about the
  // measured ones that the laboratory's bed is held to. A prototype: -17, -15, -22 %.
  const test::Results smooth = test::run_case("okushiri"),
                      rough = test::run_case("okushiri", {"bed.manning=0.025"});
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(rough.gauges[k].peak <= 0.92 * smooth.gauges[k].peak);
    CHECK(rough.gauges[k].peak < 0.9 * gauges[k].peak);
  }
}

TEST_CASE("okushiri: still water stays still at the open boundary", "[okushiri]") {
  if (skipped()) return;
  // The bed slopes 1:20 at the line; an inner state taken as depth, not level, would draw in 7e-3 m/s.
  const Scene scene = test::read_case("okushiri");
  Scene still = scene;
  test::impose(still.boundaries[0], "level", Series{{0, 1}, {0, 0}});
  const auto method = make_method(still);
  for (double t = 0; t < 2;) {
    const double dt = method->stable_dt();
    method->step(t, dt);
    t += dt;
    const FieldSet& fields = method->fields();
    // m/s; boundary particles carry their row's exterior velocity
    const auto inwards = on_host(fields.real("u"));
    const auto kind = on_host(fields.integer("kind"));
    int at_boundary = 0, moving = 0;
    for (int i = 0; i < fields.size(); ++i)
      if (kind(i) > 0) ++at_boundary, moving += !(std::abs(inwards(i)) < 1e-3);
    REQUIRE(at_boundary > 100);
    REQUIRE(moving == 0);
  }
}

// Celerity Courant number 2. Run-up: the waterline; the bed under the last wet particle is 0.069 m, and the
// next one up the valley stands 7.6 mm higher.
TEST_CASE("okushiri: semi-implicit", "[okushiri][long]") {
  if (skipped()) return;
  const test::Results s = test::run_case(
      "okushiri", {"scene.method=sisph", "sisph.theta=0.65", "sisph.courant=2", "bed.filter=none"});
  REQUIRE(s.gauges.size() == 3);
  CHECK(test::mean_rmse(s) <= 3.7e-3);
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(gauges[k].name);
    CHECK(s.gauges[k].peak == Approx(gauges[k].peak).epsilon(0.10));
    CHECK(s.gauges[k].arrival == Approx(gauges[k].arrival).margin(0.30));
  }
  REQUIRE(!s.run_ups.empty());
  CHECK(s.run_ups[0].waterline >= 0.075);
  CHECK(s.run_ups[0].waterline <= 0.11);
  CHECK(s.run_ups[0].highest >= 0.068);
  CHECK(s.mass.relative_error <= 1e-12);
}
