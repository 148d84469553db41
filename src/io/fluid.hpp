// The fluid particles on the host, for files and comparisons: boundary particles (kind > 0) are left out.
#pragma once
#include <vector>

#include "cellgrid/fields.hpp"

namespace freshet {

struct Fluid {
  std::vector<double> x, y;   // m; y is zero in 1-D
  std::vector<double> u, v;   // m/s
  std::vector<double> depth;  // m
  std::vector<double> bed;    // m; zero where the scene has no bed
  std::vector<double> mass;   // m3
  std::vector<double> h;      // m, smoothing length
  std::vector<int> id;
  std::size_t size() const { return x.size(); }
};

Fluid fluid_on_host(const FieldSet& fields);
int fluid_count(const FieldSet& fields);

}  // namespace freshet
