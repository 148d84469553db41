#include "tests/support/run/run_case.hpp"

#include <cstdlib>

#include "build_info.hpp"
#include "src/scene/read.hpp"
#include "tests/support/watch/scratch.hpp"

namespace freshet::test {

Scene read_case(const std::string& name, const std::vector<std::string>& overrides) {
  return read_scene(std::string(build::source_dir) + "/cases/" + name + ".toml", overrides);
}

Results results_of(const Driver& driver, const Method& method) {
  const Observers& all = driver.observers();
  Results r;
  static_cast<Summary&>(r) = driver.summary();
  r.mass = find<Monitor>(all)->balance(method.totals());
  r.start = find<EnergyWatch>(all)->at_start();
  r.end = method.mechanics();
  if (const auto* gauges = find<GaugeRecorder>(all)) r.gauges = gauges->results();
  if (const auto* run_ups = find<RunUpRecorder>(all)) r.run_ups = run_ups->results();
  if (const auto* transects = find<TransectRecorder>(all)) r.transects = transects->results();
  if (const auto* steadiness = find<SteadinessWatch>(all))
    r.steady = steadiness->result(method, driver.clock());
  if (const auto* errors = find<ErrorRecorder>(all))
    r.errors = errors->at_end(method, driver.clock()), r.errors_at = errors->snapshots();
  return r;
}

double mean_rmse(const Results& results) {
  double sum = 0;
  for (const GaugeResult& g : results.gauges) sum += g.rmse;
  return sum / static_cast<double>(results.gauges.size());
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
  CaseRun run{results_of(driver, *method), {}, fluid_on_host(method->fields()), method};
  if (const auto* gauges = find<GaugeRecorder>(driver.observers()))
    for (std::size_t g = 0; g < scene.gauges.size(); ++g)
      run.gauges.push_back(gauge_series(gauges->rows(), g));
  return run;
}

Results run_case(const std::string& name, const std::vector<std::string>& overrides) {
  return finish_case(name, overrides).summary;
}

bool has_okushiri_data() {
  const char* folder = std::getenv("FRESHET_DATA");
  const std::string file = "/okushiri/anuga/Benchmark_2_Bathymetry.asc";
  return (folder && std::filesystem::exists(folder + file)) ||
         std::filesystem::exists(std::string(build::source_dir) + "/data" + file);
}

}  // namespace freshet::test
