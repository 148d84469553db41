// What a particle takes in memory, counted through Kokkos' tool callbacks.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

std::map<std::string, double> bytes;  // by label, alive

// Counts what is allocated in its scope and still alive.
class Counting {
 public:
  Counting() {
    bytes.clear();
    Kokkos::Tools::Experimental::set_allocate_data_callback(
        [](const Kokkos::Profiling::SpaceHandle, const char* label, const void*, const uint64_t size) {
          bytes[label] += static_cast<double>(size);
        });
    Kokkos::Tools::Experimental::set_deallocate_data_callback(
        [](const Kokkos::Profiling::SpaceHandle, const char* label, const void*, const uint64_t size) {
          bytes[label] -= static_cast<double>(size);
        });
  }
  ~Counting() {
    Kokkos::Tools::Experimental::set_allocate_data_callback(nullptr);
    Kokkos::Tools::Experimental::set_deallocate_data_callback(nullptr);
  }
  double total() const {
    double sum = 0;
    for (const auto& [label, size] : bytes) sum += size;
    return sum;
  }
};

// Water on 200 x 200 cells, 40,000 particles.
Scene pond() {
  Scene scene = test::bare_scene(2, {0, 0}, {200, 200}, 1);
  scene.water.depth = [](double x, double y) { return 1 + 0.02 * std::sin(0.1 * x) * std::cos(0.1 * y); };
  return scene;
}

double bytes_per_particle(const Scene& scene) {
  const Counting counting;
  Flow flow(scene);
  flow.many_steps(3);
  for (const auto& [label, size] : bytes)
    if (size > 4 * flow.size()) UNSCOPED_INFO(label << ": " << size / flow.size());
  return counting.total() / flow.size();
}

}  // namespace

TEST_CASE("memory: a particle takes less than 400 bytes, over a bed with friction and walls too") {
  Scene scene = pond();
  const double flat = bytes_per_particle(scene);
  test::close_box(scene);
  scene.bed.elevation = [](double x, double) { return 1e-3 * x; };
  scene.manning = 0.02;
  const double whole = bytes_per_particle(scene);
  WARN("bytes per particle: flat " << flat << ", bed, friction and walls " << whole);
  // One lane per cluster, as on a GPU, lists some 100 neighbours of four bytes for each particle instead of
  // each eight.
  const double own_list = lanes == 1 ? 500 : 0;
  CHECK(flat < 350 + own_list);
  CHECK(whole < 400 + 1.2 * own_list);  // and the walls have lists of their own
}

TEST_CASE("memory: dry land takes a few bytes per block of the box around the water") {
  Scene scene = pond();
  const double one = bytes_per_particle(scene);
  // Two halves of the same water, 2000 m apart: the box around them is 100 times as large.
  scene.domain = {2, {0, 0}, {2000, 2000}};
  scene.water.depth = [](double x, double y) {
    return (x < 100 && y < 200) || (x > 1900 && y > 1800) ? 1 + 0.02 * std::sin(0.1 * x) * std::cos(0.1 * y)
                                                          : 0.0;
  };
  const double apart = bytes_per_particle(scene);
  CAPTURE(one, apart);
  // 3.1 blocks of 32 bins per particle, 8 bytes each, half as much to spare: 38 bytes; 32 bins for each of
  // 100 cells' 200 at most.
  CHECK(apart - one < 60);
}
