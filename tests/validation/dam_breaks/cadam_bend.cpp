// Dam break in a channel with a bend of 45 degrees (Vacondio 2010, section 3.4.3): 9,603 particles, and 2,450
// that split where they enter the channel, both against 38,412 particles, for the 20 s in which the bore goes
// from the bend back to the reservoir.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

constexpr double reservoir = 0.58;  // m, depth before the gate opens

// Of each gauge, the root mean square over time of the difference in level from the fine run [reservoir
// depths].
std::vector<double> deviations(const test::CaseRun& run, const test::CaseRun& fine) {
  std::vector<double> rms;
  for (std::size_t g = 0; g < fine.gauges.size(); ++g) {
    const Series& level = fine.gauges[g];
    double sum = 0;
    for (std::size_t k = 0; k < level.t.size(); ++k)
      sum += std::pow(run.gauges[g].at(level.t[k]) - level.value[k], 2);
    rms.push_back(std::sqrt(sum / static_cast<double>(level.t.size())) / reservoir);
  }
  return rms;
}

double largest(const std::vector<double>& rms) { return *std::max_element(rms.begin(), rms.end()); }
double mean(const std::vector<double>& rms) {
  return std::accumulate(rms.begin(), rms.end(), 0.0) / static_cast<double>(rms.size());
}

// Particles times steps: the work, which does not depend on what else the machine does.
double work(const test::Results& s) { return s.particle_steps_per_s * s.wall; }

test::CaseRun bend(const std::vector<std::string>& overrides) {
  return test::finish_case("cadam_bend", overrides);
}

}  // namespace

TEST_CASE("dam break in a bent channel, with splitting as good as without for less", "[cadam_bend][long]") {
  const test::CaseRun fine = bend({"water.spacing=0.01232"}), whole = bend({});
  const test::CaseRun split =
      bend({"water.spacing=0.0488", "split.region=[{box=[2.25,0.35,2.45,1.05],area=0.9}]", "split.relax=12"});
  CHECK(whole.summary.initial_particles == 9603);  // the thesis' two runs
  CHECK(split.summary.initial_particles == 2450);
  const std::vector<double> of_whole = deviations(whole, fine), of_split = deviations(split, fine);
  CAPTURE(of_whole, of_split, work(whole.summary), work(split.summary));
  CHECK(largest(of_whole) <=
        0.05);  // acceptance: five percent of the reservoir's depth at each of the nine gauges
  CHECK(largest(of_split) <= 0.05);
  CHECK(mean(of_split) <= mean(of_whole));  // acceptance: no larger error against the fine run
  // The thesis saves 40 % of the time; times are in docs/log/accuracy.md.
  CHECK(work(split.summary) <= 0.6 * work(whole.summary));
  for (const test::CaseRun* run : {&fine, &whole, &split}) CHECK(run->summary.mass.relative_error <= 1e-12);
}
