// What fields are filled with from the host. Kokkos::deep_copy, compiled once: 0.3 s for each kind of view in
// each source that calls it.
#pragma once
#include <utility>
#include <vector>

#include "cellgrid/parallel/types.hpp"

namespace freshet {

// What Kokkos::create_mirror_view makes of a field.
template <class T>
using HostMirror = decltype(Kokkos::create_mirror_view(std::declval<const Kokkos::View<T*, Memory>&>()));

void assign(const Field<double>& field, double value);  // the same everywhere
void assign(const Field<int>& field, int value);
void assign(const Field<double>& field, const HostMirror<double>& values);  // as many values as the field has
void assign(const Field<int>& field, const HostMirror<int>& values);

// The first n values: value(i) of each i, asked on the host.
template <class T, class F>
void upload(const Field<T>& field, std::size_t n, const F& value) {
  const HostMirror<T> host = Kokkos::create_mirror_view(field);
  for (std::size_t i = 0; i < n; ++i) host(i) = value(i);
  assign(field, host);
}
template <class T>
void upload(const Field<T>& field, const std::vector<T>& values) {
  upload(field, values.size(), [&](std::size_t i) { return values[i]; });
}

}  // namespace freshet
