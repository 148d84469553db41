// summary.json is JSON whatever the numbers and names.
#include <catch2/catch.hpp>

#include "src/io/json.hpp"
#include "src/io/summary.hpp"

using namespace freshet;

TEST_CASE("JSON values: digits that read back, null for what is not finite, escaped text") {
  JsonWriter out;
  out.begin().value("a", 0.1).value("b", unknown).value("c", "say \"hi\"\n\\").begin("d").end();
  out.array("e").value("", 1).value("", 2.5).end_array().end();
  CHECK(out.text() ==
        "{\n  \"a\": 0.1,\n  \"b\": null,\n  \"c\": \"say \\\"hi\\\"\\u000a\\\\\",\n  \"d\": {},\n"
        "  \"e\": [\n    1,\n    2.5\n  ]\n}");
}

TEST_CASE("the summary holds the promised keys, errors only where the scene names a reference") {
  Summary summary;
  summary.scene_case = "okushiri";
  summary.gauges.resize(1);
  summary.gauges[0].name = "ch5";
  summary.gauges[0].rmse = 0.0035;
  summary.run_ups.push_back({"valley", 0.0875, 0.0885, {}});
  const std::string text = json(summary);
  for (const char* key : {"case",
                          "method",
                          "backend",
                          "threads",
                          "particles",
                          "initial",
                          "final",
                          "steps",
                          "simulated_s",
                          "wall_s",
                          "particle_steps_per_s",
                          "mass",
                          "initial_m3",
                          "inflow_m3",
                          "outflow_m3",
                          "final_m3",
                          "relative_error",
                          "flux_error",
                          "gauges",
                          "ch5",
                          "max_abs_error",
                          "peak",
                          "peak_time",
                          "measured_peak",
                          "arrival",
                          "measured_arrival",
                          "runup",
                          "waterline"}) {
    CAPTURE(key);
    CHECK(text.find('"' + std::string(key) + "\": ") != std::string::npos);
  }
  CHECK(text.find("\"rmse\": 0.0035,") != std::string::npos);
  CHECK(text.find("\"valley\": 0.0875") != std::string::npos);
  CHECK(text.find("\"flux_error\": null") != std::string::npos);
  CHECK(text.find("errors") == std::string::npos);
  summary.compared = true;
  for (const char* key : {"depth_l1_rel", "depth_l2_rel", "depth_linf", "velocity_l2", "grid_l2_rel"}) {
    CHECK(json(summary).find('"' + std::string(key) + "\": null") != std::string::npos);
  }
}
