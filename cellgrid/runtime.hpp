// Starts and stops Kokkos. The only place that does: Kokkos never sees our command line.
#pragma once

namespace freshet {

// Lives as long as particle data may exist. threads = 0 means all physical cores that this process may use.
struct Runtime {
  explicit Runtime(int threads = 0);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
};

const char* backend_name();  // "OpenMP", "Serial", ...
int thread_count();

}  // namespace freshet
