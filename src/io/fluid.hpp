// The fluid particles on the host, for files and comparisons: boundary particles (kind > 0) are left out.
#pragma once
#include <vector>

#include "cellgrid/particles/fields.hpp"

namespace freshet {

struct Fluid {
  std::vector<double> x, y;   // m; y is zero in 1-D
  std::vector<double> u, v;   // m/s
  std::vector<double> depth;  // m
  std::vector<double> mass;   // m3
  std::vector<double> h;      // m, smoothing length
  std::vector<int> id;
  std::size_t size() const { return x.size(); }
};

// Places of the fluid particles in the fields, and what a field holds there; zeros if nobody made it.
std::vector<int> fluid_indices(const FieldSet& fields);
template <class T>
std::vector<T> gather(const NamedField<T>* field, const std::vector<int>& indices) {
  std::vector<T> values(indices.size(), T(0));
  if (!field) return values;
  const auto data = on_host(field->data);
  for (std::size_t k = 0; k < indices.size(); ++k) values[k] = data(indices[k]);
  return values;
}

Fluid fluid_on_host(const FieldSet& fields);
int fluid_count(const FieldSet& fields);

}  // namespace freshet
