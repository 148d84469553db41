// Starts and stops Kokkos. The only place that does: Kokkos never sees our command line.
#pragma once
#include <string>

namespace freshet {

// Lives as long as particle data may exist. threads = 0 means all physical cores that this process may use.
struct Runtime {
  explicit Runtime(int threads = 0);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
};

const char* backend_name();    // "OpenMP", "Serial", ...
const char* registers_name();  // of the vector registers that this program was built for: "AVX-512", "AVX2",
                               // "SSE", "NEON", ...
// What to do where the machine has wider ones than those; empty where it has not.
std::string better_registers();
int thread_count();

}  // namespace freshet
