// A field with the values of a vector: what set-up makes on the host and kernels read.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "cellgrid/types.hpp"

namespace freshet {

template <class T>
Field<T> on_device(const std::string& label, const std::vector<T>& values) {
  const Field<T> field(Kokkos::ViewAllocateWithoutInitializing(label), values.size());
  const auto host = Kokkos::create_mirror_view(field);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(field, host);
  return field;
}

}  // namespace freshet
