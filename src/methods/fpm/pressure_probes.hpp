// Pressures at fixed places, for gauges: one look at all of them, some bytes of each to the host.
#pragma once
#include <vector>

#include "kernels/fpm/points/transfer.hpp"
#include "src/scene/scene.hpp"

namespace freshet::fpm {

struct Probe {
  double pressure;  // Pa, 0 where it is dry
  int wet;          // whether a point is near
};

class PressureProbes {
 public:
  // Of the gauges that show pressures, in their order. p: at every point [Pa].
  std::vector<Probe> look(const Scene& scene, const std::vector<Gauge>& gauges, const Near& near,
                          const Field<double>& p);

 private:
  void lay(const Scene& scene, const std::vector<Point>& places);

  std::vector<Point> places_;
  VecField<double, 2> place_;        // m
  Field<double> h_, slack_, reach_;  // m, x range, m
  Field<double> value_;              // Pa
  Kokkos::View<Probe*, Memory> probe_;
  Transfer transfer_;
};

}  // namespace freshet::fpm
