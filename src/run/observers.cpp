#include "src/run/observers.hpp"

#include <type_traits>

#include "src/run/record/errors.hpp"
#include "src/run/record/gauges.hpp"
#include "src/run/record/particles.hpp"
#include "src/run/record/rasters.hpp"
#include "src/run/record/run_ups.hpp"
#include "src/run/record/transects.hpp"
#include "src/run/watch/energy.hpp"
#include "src/run/watch/monitor.hpp"
#include "src/run/watch/stability.hpp"
#include "src/run/watch/steadiness.hpp"

namespace freshet {
namespace {

struct Kind {
  std::vector<std::string> (*files)();
  std::unique_ptr<Observer> (*make)(const Scene& scene, const std::string& directory);
};

template <class One>
constexpr Kind kind() {
  return {One::files, [](const Scene& scene, const std::string& directory) -> std::unique_ptr<Observer> {
            if (!One::wanted(scene)) return nullptr;
            if constexpr (std::is_constructible_v<One, const Scene&, const std::string&>)
              return std::make_unique<One>(scene, directory);
            else return std::make_unique<One>(scene);
          }};
}

// In the order in which they are called and report. The monitor comes first: it stops a run before others
// look at garbage.
constexpr Kind kinds[] = {kind<Monitor>(),          kind<StabilityWatch>(), kind<EnergyWatch>(),
                          kind<ParticleRecorder>(), kind<GaugeRecorder>(),  kind<RunUpRecorder>(),
                          kind<TransectRecorder>(), kind<ErrorRecorder>(),  kind<SteadinessWatch>(),
                          kind<RasterRecorder>()};

}  // namespace

Observers make_observers(const Scene& scene, const std::string& directory) {
  Observers observers;
  for (const Kind& one : kinds)
    if (auto observer = one.make(scene, directory)) observers.push_back(std::move(observer));
  return observers;
}

std::vector<std::string> observed_files() {
  std::vector<std::string> all;
  for (const Kind& one : kinds)
    for (const auto& file : one.files()) all.push_back(file);
  return all;
}

}  // namespace freshet
