// The labels of launches and allocations, through Kokkos' tool callbacks.
#pragma once
#include <Kokkos_Core.hpp>

#include <set>
#include <string>
#include <vector>

namespace freshet::test {

inline std::vector<std::string>* launched = nullptr;
inline std::vector<std::string>* allocated = nullptr;

// Records the labels of launches and allocations through Kokkos' tool callbacks for the length of a scope.
class Recording {
 public:
  std::vector<std::string> launches, allocations;

  Recording() {
    launched = &launches, allocated = &allocations;
    const auto launch = [](const char* label, const uint32_t, uint64_t*) { launched->push_back(label); };
    set_launch(launch);
    Kokkos::Tools::Experimental::set_allocate_data_callback(
        [](const Kokkos::Profiling::SpaceHandle, const char* label, const void*, const uint64_t) {
          allocated->push_back(label);
        });
  }
  ~Recording() {
    set_launch(nullptr);
    Kokkos::Tools::Experimental::set_allocate_data_callback(nullptr);
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  std::set<std::string> labels() const { return {launches.begin(), launches.end()}; }

 private:
  static void set_launch(void (*callback)(const char*, const uint32_t, uint64_t*)) {
    Kokkos::Tools::Experimental::set_begin_parallel_for_callback(callback);
    Kokkos::Tools::Experimental::set_begin_parallel_reduce_callback(callback);
    Kokkos::Tools::Experimental::set_begin_parallel_scan_callback(callback);
  }
};

}  // namespace freshet::test
