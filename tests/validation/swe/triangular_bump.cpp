// Dam break over a triangular bump (CADAM, 38 m channel): four gauges against the measured depths, and
// against a finite-volume solution of the same equations, which tells what is the particles' and what the
// equations' doing.
#include <catch2/catch.hpp>

#include "tests/support/run/data.hpp"
#include "tests/support/run/run_case.hpp"
#include "tests/support/solve/channel.hpp"

using namespace freshet;

namespace {

constexpr double reservoir = 0.75, manning = 0.0125;   // m, s/m^(1/3)
constexpr double reading = 0.005, reading_time = 0.1;  // m, s, errors of the digitised curves

struct Deviation {
  double sum = 0;
  int count = 0;
  void add(double difference) {
    sum += difference * difference;
    ++count;
  }
  double rms() const { return std::sqrt(sum / count); }
};

test::Channel channel(const Scene& scene, int cells) {
  return {0,
          38,
          cells,
          scene.gravity,
          manning,
          [&](double x) { return scene.bed.elevation(x, 0); },
          [&](double x) { return scene.water.depth(x, 0); },
          {}};
}

// The levels of the finite volumes at the gauges every 0.05 s.
std::vector<Series> finite_volumes(const Scene& scene) {
  test::ChannelFlow flow(channel(scene, 1520));
  std::vector<Series> levels(scene.gauges.size());
  for (int row = 0; row <= 800; ++row) {
    while (flow.time() < 0.05 * row) flow.step(0.05 * row);
    for (std::size_t g = 0; g < levels.size(); ++g) {
      levels[g].t.push_back(0.05 * row);
      levels[g].value.push_back(flow.level(scene.gauges[g].at[0]));
    }
  }
  return levels;
}

double rms(const Series& at, const Series& computed) {
  Deviation d;
  for (std::size_t k = 0; k < at.t.size(); ++k) d.add(computed.at(at.t[k]) - at.value[k]);
  return d.rms();
}

}  // namespace

TEST_CASE("dam break over a triangular bump", "[triangular_bump][long]") {
  if (!test::data_file("triangular_bump/clean/G4.csv")) return;
  const Scene scene = test::read_case("triangular_bump");
  const std::vector<Series> reference = finite_volumes(scene);
  const test::CaseRun run = test::finish_case("triangular_bump");
  for (std::size_t g = 0; g < scene.gauges.size(); ++g) {
    CAPTURE(scene.gauges[g].name);
    const GaugeResult& result = run.summary.gauges[g];
    const Series& measured = *scene.gauges[g].measured;
    // Against the same equations: two percent of the reservoir's depth.
    CHECK(rms(reference[g], run.gauges[g]) <= 0.02 * reservoir);
    // Against the experiment no worse than the equations themselves, but for the errors of reading: they turn
    // the broad front of the reflected bore into a jump (7, 9, 3 and 3 cm rms) and come 0.4 s early to the
    // bump.
    CHECK(result.rmse <= rms(measured, reference[g]) + reading);
    CHECK(result.peak <= peak_after(reference[g], 0, 40).value + reading);
    CHECK(result.peak >= 0.9 * result.measured_peak);
    const double arrival = arrival_after(reference[g], scene.gauges[g].arrival_level, 0, 40);
    CHECK(std::abs(result.arrival - result.measured_arrival) <=
          std::abs(arrival - result.measured_arrival) + reading_time);
  }
  CHECK(run.summary.mass.relative_error <= 1e-12);
}
