#include "tests/support/run_case.hpp"

#include <cstdlib>

#include "build_info.hpp"
#include "src/run/gauge_stats.hpp"
#include "src/scene/read.hpp"
#include "tests/support/scratch.hpp"

namespace freshet::test {

Scene read_case(const std::string& name, const std::vector<std::string>& overrides) {
  return read_scene(std::string(build::source_dir) + "/cases/" + name + ".toml", overrides);
}

CaseRun finish_case(const std::string& name, const std::vector<std::string>& overrides) {
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

Summary run_case(const std::string& name, const std::vector<std::string>& overrides) {
  return finish_case(name, overrides).summary;
}

bool has_okushiri_data() {
  const char* folder = std::getenv("FRESHET_DATA");
  const std::string file = "/okushiri/anuga/Benchmark_2_Bathymetry.asc";
  return (folder && std::filesystem::exists(folder + file)) ||
         std::filesystem::exists(std::string(build::source_dir) + "/data" + file);
}

}  // namespace freshet::test
