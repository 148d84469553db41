// What crosses between host and device and what the host waits for, step by step: through Kokkos' tool
// callbacks and on_host's.
#pragma once
#include <Kokkos_Core.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cellgrid/parallel/types.hpp"

namespace freshet::test {

using Waits = std::map<std::string, int>;  // how often the host waits, by what for

struct StepTraffic {
  Waits waits;
  std::map<std::string, std::size_t> copies;  // bytes of the largest copy, by the label of what is copied

  long iterations = 0;  // of an implicit method's solvers

  void copied(const std::string& label, std::size_t bytes) {
    ++waits["copy " + label];
    copies[label] = std::max(copies[label], bytes);
  }
};

inline StepTraffic* traffic = nullptr;

// Sums over particles (cellgrid/particles/sums.hpp) are counted together.
inline const std::string sums = "sums";
inline bool is_sum(const char* label) {
  static const std::set<std::string> labels{"swe::mass",
                                            "swe::mechanics",
                                            "open::convert",
                                            "open::straddling",
                                            "sisph::mass",
                                            "sisph::mechanics",
                                            "sisph::coefficients",
                                            "sisph::limit_outflow",
                                            "sisph::residual",
                                            "sisph::product",
                                            "sisph::clip",
                                            "sisph::rim_flow",
                                            "sisph::increment",
                                            "cg::residual",
                                            "cg::advance",
                                            "linear::dot",
                                            "linear::dots",
                                            "linear::subtract_from",
                                            "bicgstab::step_along",
                                            "bicgstab::advance",
                                            "point_mesh::weight",
                                            "fpm::mean",
                                            "fpm::speed",
                                            "fpm::mechanics",
                                            "fpm::area"};
  return labels.count(label) > 0;
}

// Records for the length of a scope. Where host and device share memory a copy to or from a mirror is one of
// a view to itself. A reduction's result and a number read from a view go to the host; so does the sum of the
// scans named here. Fills and copies on the device are waits alone.
class TrafficRecording {
 public:
  TrafficRecording() {
    traffic = &now_;
    on_host_read = [](const char* label, std::size_t bytes) { traffic->copied(label, bytes); };
    namespace tools = Kokkos::Tools::Experimental;
    using Space = Kokkos::Profiling::SpaceHandle;
    tools::set_begin_deep_copy_callback([](Space, const char* to, const void* to_data, Space,
                                           const char* from, const void* from_data, uint64_t bytes) {
      const bool crosses = to == std::string("Scalar") || to_data == from_data;
      crosses ? traffic->copied(from, bytes) : void(++traffic->waits["device " + std::string(to)]);
    });
    tools::set_begin_parallel_reduce_callback(
        [](const char* label, const uint32_t, uint64_t*) { ++traffic->waits[is_sum(label) ? sums : label]; });
    tools::set_begin_parallel_scan_callback([](const char* label, const uint32_t, uint64_t*) {
      static const std::set<std::string> with_result{"split::choose", "sisph::place_slots",
                                                     "sisph::list_active", "fpm::new_places"};
      if (with_result.count(label) > 0) ++traffic->waits[label];
    });
  }
  ~TrafficRecording() {
    on_host_read = nullptr;
    namespace tools = Kokkos::Tools::Experimental;
    tools::set_begin_deep_copy_callback(nullptr);
    tools::set_begin_parallel_reduce_callback(nullptr);
    tools::set_begin_parallel_scan_callback(nullptr);
  }
  TrafficRecording(const TrafficRecording&) = delete;
  TrafficRecording& operator=(const TrafficRecording&) = delete;

  void end_step() { steps.push_back(now_), now_ = {}; }
  std::vector<StepTraffic> steps;

 private:
  StepTraffic now_;
};

}  // namespace freshet::test
