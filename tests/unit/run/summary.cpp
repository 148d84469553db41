// summary.json is JSON whatever the numbers and names.
#include <catch2/catch.hpp>

#include "src/io/json.hpp"
#include "src/reference/exact.hpp"
#include "src/run/driver.hpp"
#include "src/run/record/gauges.hpp"
#include "src/text.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

TEST_CASE("JSON values: digits that read back, null for what is not finite, escaped text") {
  JsonWriter out;
  out.begin().value("a", 0.1).value("b", unknown).value("c", "say \"hi\"\n\\").begin("d").end();
  out.array("e").value("", 1).value("", 2.5).end_array().end();
  CHECK(out.text() ==
        "{\n  \"a\": 0.1,\n  \"b\": null,\n  \"c\": \"say \\\"hi\\\"\\u000a\\\\\",\n  \"d\": {},\n"
        "  \"e\": [\n    1,\n    2.5\n  ]\n}");
}

TEST_CASE("members that others wrote stand as if they had been written in their place") {
  JsonWriter part(1), whole;
  part.value("a", 1).begin("b").value("c", 2).end();
  whole.begin().members(part.text()).value("d", 3).end();
  CHECK(whole.text() == "{\n  \"a\": 1,\n  \"b\": {\n    \"c\": 2\n  },\n  \"d\": 3\n}");
}

TEST_CASE("the summary holds what is promised of every run, in its order, empty where there is none") {
  Summary summary;
  summary.scene_case = "okushiri";
  summary.report.object("later").end();
  summary.report.object("runup").value("valley", 0.0875).end();
  summary.report.warnings = {"deep water"};
  const std::string text = json(summary);
  std::size_t at = 0;
  for (const char* key :
       {"case",    "method", "version",  "backend",       "registers",   "threads", "particles",
        "initial", "final",  "steps",    "list_rebuilds", "simulated_s", "wall_s",  "particle_steps_per_s",
        "mass",    "energy", "momentum", "warnings",      "gauges",      "runup",   "waterline",
        "later"}) {
    CAPTURE(key);
    const auto found = text.find('"' + std::string(key) + "\": ", at);
    REQUIRE(found != std::string::npos);
    at = found;
  }
  CHECK(text.find("\"warnings\": [\n    \"deep water\"\n  ],\n  \"gauges\": {},\n") != std::string::npos);
  CHECK(text.find("\"runup\": {\n    \"valley\": 0.0875\n  },\n  \"waterline\": {}") != std::string::npos);
}

TEST_CASE("a table has errors and peaks in the units of what its gauges show") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene();
  scene.gauges.push_back(scene.gauges[0]);
  scene.gauges[1].name = "wall", scene.gauges[1].what = Gauge::What::pressure;
  test::FakeMethod method(scene);
  GaugeRecorder gauges(scene, scratch.path());
  gauges.begin(method);
  Report report;
  gauges.report(method, {}, report);
  const std::string& tables = report.tables;
  const auto level = tables.find("peak [cm]"), middle = tables.find("\nmiddle");
  const auto pascals = tables.find("peak [Pa]"), wall = tables.find("\nwall");
  CHECK((level < middle && middle < pascals && pascals < wall && wall != std::string::npos));
  const auto shown = [&](std::size_t at) {  // the first number of the row: the peak that was run
    return std::stod(tables.substr(tables.find_first_of("0123456789", at)));
  };
  // The fake method tells the same number for both; it is printed with two digits behind the point.
  CHECK(shown(middle) == Approx(100 * gauges.rows()[0].value[0]).margin(0.005));
  CHECK(shown(wall) == Approx(gauges.rows()[0].value[1]).margin(0.005));
}

TEST_CASE("observers write their promised keys, errors only where the scene names a reference") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene();
  scene.gauges[0].measured = Series{{0, 1}, {1, 1}};
  const auto text_of = [&](const Scene& of) {
    test::FakeMethod method(of);
    Driver driver(of, method, {scratch.path()});
    driver.begin();
    driver.run();
    return json(driver.summary());
  };
  const std::string text = text_of(scene);
  for (const char* key :
       {"initial_m3", "inflow_m3", "outflow_m3", "final_m3", "relative_error", "flux_error", "middle", "rmse",
        "max_abs_error", "peak", "peak_time", "measured_peak", "arrival", "measured_arrival", "shore"}) {
    CAPTURE(key);
    CHECK(text.find('"' + std::string(key) + "\": ") != std::string::npos);
  }
  CHECK(text.find("\"flux_error\": null") != std::string::npos);
  // The gauge's measured level is 1 m; the number under the key is the one of its statistics.
  test::FakeMethod method(scene);
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  driver.run();
  const std::vector<GaugeResult> gauges = find<GaugeRecorder>(driver.observers())->results();
  CHECK(text.find("\"rmse\": " + shortest(gauges.at(0).rmse) + ",") != std::string::npos);
  CHECK(text.find("errors") == std::string::npos);
  scene.compare.exact = stoker(2, 1, 0, 9.81);
  const std::string compared = text_of(scene);
  for (const char* key : {"depth_l1_rel", "depth_l2_rel", "depth_linf", "velocity_l2", "grid_l2_rel"}) {
    CAPTURE(key);
    CHECK(compared.find('"' + std::string(key) + "\": ") != std::string::npos);
  }
}
