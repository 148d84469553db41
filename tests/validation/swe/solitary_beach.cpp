// A solitary wave on a plane beach against the analytical solution of Synolakis (1987), benchmark BP01 of the
// NTHMP.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/data.hpp"
#include "tests/support/run/run_case.hpp"
#include "tests/support/run/scenes.hpp"

using namespace freshet;

namespace {

constexpr double run_up = 0.0909;  // the highest level of the published profiles, at t = 55

// Elevation of the water, of the bed where it is dry.
double elevation(const Method& method, double x) {
  const PointState state = method.sample({{x, 0}})[0];
  return state.bed + (state.reached ? state.depth : 0);
}

// Rms over the published points of column `column`; NaN stands for dry land there.
double profile_error(const Method& method, const std::vector<std::vector<double>>& rows, std::size_t column) {
  double sum = 0, count = 0;
  for (const auto& row : rows) {
    if (row.size() <= column || std::isnan(row[column])) continue;
    sum += std::pow(elevation(method, row[0]) - row[column], 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 1e300;
}

// Highest surface of any particle at least a thousandth deep: at the shore it and the bed meet.
double highest(const test::Flow& flow) {
  double most = -1;
  const auto depth = flow.real("depth"), bed = flow.real("bed");
  for (int i = 0; i < flow.size(); ++i)
    if (depth(i) >= 1e-3) most = std::max(most, bed(i) + depth(i));
  return most;
}

// Both methods have the bounds of the case.
Scene scene_of(const std::string& method) {
  if (method == "sph-swe") return test::read_case("solitary_beach");
  return test::read_case("solitary_beach",
                         {"scene.method=" + method, "water.start=cells", "sisph.theta=0.5"});
}

// Rms over the published times of column `time` up to the end of the case, against the column beside it.
double series_error(const std::vector<std::vector<double>>& rows, std::size_t time, double x,
                    const std::string& method) {
  test::Flow flow(scene_of(method));
  double sum = 0, count = 0;
  for (const auto& row : rows) {
    if (row.size() < time + 2 || row[time] > 70) continue;
    flow.run(row[time]);
    if (std::isnan(row[time + 1])) continue;
    sum += std::pow(elevation(*flow.method, x) - row[time + 1], 2);
    ++count;
  }
  return count > 100 ? std::sqrt(sum / count) : 1e300;
}

}  // namespace

TEST_CASE("a solitary wave runs up the beach as Synolakis says") {
  const auto file = test::data_file("nthmp/BP01-DmitryN-Single_wave_on_simple_beach/canonical_profiles.txt");
  if (!file) return;
  const auto rows = test::number_rows(*file);
  REQUIRE(rows.size() > 200);
  const std::string method = GENERATE("sph-swe", "sisph");
  test::Flow flow(scene_of(method));
  double top = -1;
  std::size_t column = 1;
  for (double t = 35; t <= 70; t += 5, ++column) {
    flow.run(t, [&] { top = std::max(top, highest(flow)); });
    CAPTURE(method, t);
    CHECK(profile_error(*flow.method, rows, column) <= 0.03 * run_up);
  }
  CHECK(top == Approx(run_up).epsilon(0.05));
}

TEST_CASE("the solitary wave passes two points of the beach at the right time") {
  const auto file = test::data_file("nthmp/BP01-DmitryN-Single_wave_on_simple_beach/canonical_ts.txt");
  if (!file) return;
  const auto rows = test::number_rows(*file);
  const std::string method = GENERATE("sph-swe", "sisph");
  CAPTURE(method);
  CHECK(series_error(rows, 0, 0.25, method) <= 0.03 * run_up);
  CHECK(series_error(rows, 2, 9.95, method) <= 0.03 * run_up);
}
