// A field with the values of a vector: what set-up makes on the host and kernels read. Waits for the copy.
#pragma once
#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "cellgrid/parallel/assign.hpp"

namespace freshet {

template <class T>
Kokkos::View<T*, Memory> on_device(const std::string& label, const std::vector<T>& values) {
  const Kokkos::View<T*, Memory> view(Kokkos::ViewAllocateWithoutInitializing(label), values.size());
  const auto host = Kokkos::create_mirror_view(view);
  std::copy(values.begin(), values.end(), host.data());
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) assign(view, host);
  else Kokkos::deep_copy(view, host);
  return view;
}

}  // namespace freshet
