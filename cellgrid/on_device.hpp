// Values of the host in a view of their own; waits for the copy.
#pragma once
#include "cellgrid/types.hpp"

#include <vector>

namespace freshet {

template <class T>
Kokkos::View<T*, Memory> on_device(const std::string& label, const std::vector<T>& values) {
  const Kokkos::View<T*, Memory> view(label, values.size());
  const auto host = Kokkos::create_mirror_view(view);
  for (std::size_t k = 0; k < values.size(); ++k) host(k) = values[k];
  Kokkos::deep_copy(view, host);
  return view;
}

}  // namespace freshet
