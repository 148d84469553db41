// Runs one of the scenes in cases/ to its end, as the program does, and returns its summary and its water.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "build_info.hpp"
#include "src/io/fluid.hpp"
#include "src/method.hpp"
#include "src/run/driver.hpp"
#include "src/run/gauge_stats.hpp"
#include "src/scene/read.hpp"
#include "tests/support/scratch.hpp"

namespace freshet::test {

inline Scene read_case(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(std::string(build::source_dir) + "/cases/" + name + ".toml", overrides);
}

struct CaseRun {
  Summary summary;
  std::vector<Series> gauges;  // m, elevations in the order of the scene
  Fluid fluid;                 // at the end
  std::shared_ptr<const Method> method;  // likewise

  template <class Where>
  double mass_where(const Where& where) const {  // m3
    double sum = 0;
    for (std::size_t i = 0; i < fluid.size(); ++i)
      if (where(fluid.x[i], fluid.y[i])) sum += fluid.mass[i];
    return sum;
  }
};

inline CaseRun finish_case(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const Scratch scratch;
  const Scene scene = read_case(name, overrides);
  const std::shared_ptr<Method> method = make_method(scene);
  RunOptions options;
  options.directory = scratch.path();
  Driver driver(scene, *method, options);
  driver.begin();
  driver.run();
  CaseRun run{driver.summary(), {}, fluid_on_host(method->fields()), method};
  for (std::size_t g = 0; g < scene.gauges.size(); ++g) run.gauges.push_back(gauge_series(driver.gauge_rows(), g));
  return run;
}

inline Summary run_case(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return finish_case(name, overrides).summary;
}

// Whether the Okushiri benchmark's files are where a scene would find them.
inline bool has_okushiri_data() {
  const char* folder = std::getenv("FRESHET_DATA");
  const std::string file = "/okushiri/anuga/Benchmark_2_Bathymetry.asc";
  return (folder && std::filesystem::exists(folder + file)) ||
         std::filesystem::exists(std::string(build::source_dir) + "/data" + file);
}

}  // namespace freshet::test
