#include "cellgrid/parallel/runtime.hpp"

#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "cellgrid/simd/registers.hpp"

namespace freshet {
namespace {

// Physical cores: hyper-threads share the vector units that the pair loops saturate.
int physical_cores() {
  std::set<std::pair<std::string, std::string>> cores;
  const int logical = static_cast<int>(std::thread::hardware_concurrency());
  for (int cpu = 0; cpu < logical; ++cpu) {
    const std::string topology = "/sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/topology/";
    std::string package, core;
    std::ifstream(topology + "physical_package_id") >> package;
    std::ifstream(topology + "core_id") >> core;
    if (!core.empty()) cores.insert({package, core});
  }
  return cores.empty() ? (logical > 0 ? logical : 1) : static_cast<int>(cores.size());
}

}  // namespace

Runtime::Runtime(int threads) {
  const int wanted = threads > 0 ? threads : physical_cores();
#if KOKKOS_VERSION < 30700
  Kokkos::InitArguments arguments;
  arguments.num_threads = wanted;
  arguments.disable_warnings = true;
  Kokkos::initialize(arguments);
#else
  Kokkos::initialize(Kokkos::InitializationSettings().set_num_threads(wanted).set_disable_warnings(true));
#endif
}

Runtime::~Runtime() { Kokkos::finalize(); }

const char* backend_name() { return Exec::name(); }

#ifdef FRESHET_DEVICE
const char* registers_name() { return "none"; }
std::string better_registers() { return {}; }
#else
const char* registers_name() { return instruction_set; }
std::string better_registers() {
  const std::string machine = machine_instruction_set();
  if (machine == instruction_set) return {};
  return "this machine has " + machine +
         ": a build with FRESHET_ARCH=native, as the preset release is, uses it";
}
#endif

int thread_count() { return Exec().concurrency(); }

}  // namespace freshet
