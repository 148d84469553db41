// Solitary wave on a conical island (Briggs et al. 1995, NTHMP BP06, case A): run-up around the island and
// gauges.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/run/data.hpp"
#include "tests/support/run/run_case.hpp"

using namespace freshet;

TEST_CASE("a solitary wave wraps around a conical island", "[bp06][long]") {
  if (!test::data_file("nthmp/BP06/briggs_caseA_gauges.csv")) return;
  const Scene scene = test::read_case("bp06");
  const test::Results s = test::run_case("bp06");
  // Two sources of the measured run-up disagree (3.2 against 4.16 cm in front): between them, 20 % more on
  // either side, which is the tolerance of the benchmark's own scripts (ptha).
  double highest = 0;
  for (const RunUpResult& r : s.run_ups) {
    CAPTURE(r.name);
    CHECK(r.highest >= 0.8 * r.measured.first);
    CHECK(r.highest <= 1.2 * r.measured.second);
    highest = std::max(highest, r.highest);
  }
  CHECK(highest >= 0.032);         // the lower of the two sources
  CHECK(highest <= 1.2 * 0.0416);  // 20 % above the upper
  // FUNWAVE without dispersion on 2.5 cm cells, in the same scripts: the same equations, a tenth.
  CHECK(highest == Approx(0.0404).epsilon(0.1));
  // Peaks at the gauges beside the island: mean relative error below 0.2, as in the same scripts.
  double peaks = 0, errors = 0;
  int beside = 0;
  for (std::size_t g = 0; g < s.gauges.size(); ++g) {
    const GaugeResult& r = s.gauges[g];
    const auto range =
        std::minmax_element(scene.gauges[g].measured->value.begin(), scene.gauges[g].measured->value.end());
    errors += r.rmse / (*range.second - *range.first) / static_cast<double>(s.gauges.size());
    if (r.name == "g1" || r.name == "g2") continue;
    peaks += std::abs(r.peak / r.measured_peak - 1);
    ++beside;
  }
  REQUIRE(beside == 4);
  CHECK(peaks / beside < 0.2);
  CHECK(errors < 0.2);  // of the whole series, relative to the measured range: held to the peaks' fifth
  CHECK(s.mass.relative_error <= 1e-12);
}
