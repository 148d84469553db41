// Large arrays that are streamed over and over: pages of 2 MB instead of 4 kB spare most look-ups of
// addresses, which cost half of the time of a matrix product on a virtual machine. Asked for before the first
// write; where the system knows none nothing happens.
#pragma once
#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstdint>

#include "cellgrid/parallel/types.hpp"

namespace freshet {

template <class View>
void prefer_huge_pages(const View& view) {
#if defined(__linux__) && !defined(FRESHET_DEVICE)
  constexpr std::uintptr_t page = 1u << 21;
  const auto begin = (reinterpret_cast<std::uintptr_t>(view.data()) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(view.data() + view.span()) / page * page;
  if (begin < end)
    madvise(reinterpret_cast<void*>(begin), end - begin,
            MADV_HUGEPAGE);  // a refusal changes nothing but the speed
#else
  (void)view;
#endif
}

}  // namespace freshet
