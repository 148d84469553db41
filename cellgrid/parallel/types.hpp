// Names shared by every part: the execution space, particle fields, and profile regions.
#pragma once
#include <Kokkos_Core.hpp>

#include <cstddef>
#include <string>
#include <type_traits>

#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP)
#define FRESHET_DEVICE  // passes run on a GPU
#endif

// Of a lambda: no call, and no memory for what it returns.
#define FRESHET_INLINE_LAMBDA __attribute__((always_inline))
// Of a function: a call wherever it is used, so that its bits do not depend on what it would be merged with,
// and its code is there once.
#define FRESHET_OUT_OF_LINE __attribute__((noinline))

namespace freshet {

inline constexpr double pi = 3.14159265358979323846;

#ifdef FRESHET_SERIAL
using Exec = Kokkos::Serial;
#else
using Exec = Kokkos::DefaultExecutionSpace;
#endif
// On a GPU managed memory: set-up and outputs read fields on the host.
#if defined(KOKKOS_ENABLE_CUDA) && !defined(FRESHET_SERIAL)
using Memory = Kokkos::CudaUVMSpace;
#elif defined(KOKKOS_ENABLE_HIP) && !defined(FRESHET_SERIAL)
using Memory = Kokkos::Experimental::HIPManagedSpace;
#else
using Memory = Exec::memory_space;
#endif
using Range = Kokkos::RangePolicy<Exec>;

// One value per particle: a view that is allocated, copied and let go of by functions compiled once, not in
// every source.
template <class T>
class Field : public Kokkos::View<T*, Memory> {
 public:
  using View = Kokkos::View<T*, Memory>;
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, int>,
                "types.cpp has functions for these alone: use a Kokkos::View");

  Field() = default;
#ifndef FRESHET_DEVICE  // out of line: passes copy dozens, each a call and three branches
  Field(const Field& other) noexcept;
  Field(Field&& other) noexcept : View(static_cast<View&&>(other)) {}
  Field& operator=(const Field& other) noexcept;
  Field& operator=(Field&& other) noexcept { return View::operator=(static_cast<View&&>(other)), *this; }
  ~Field();
#endif
  Field(const std::string& label, size_t values);  // zeros
  explicit Field(const std::string& label) : Field(label, 0) {}
  // Kokkos::ViewAllocateWithoutInitializing(label)
  template <class Allocation, class = std::enable_if_t<!std::is_convertible_v<Allocation, std::string>>>
  Field(const Allocation& allocation, size_t values) : View(allocation, values) {}
  template <class... Traits>
  KOKKOS_FUNCTION Field(const Kokkos::View<Traits...>& other) : View(other) {}
};
template <class T>
using Input = Kokkos::View<const T*, Memory>;

// Room for at least n values; where it grows, by half, what it held is lost.
template <class View>
void reserve(View& view, const char* label, int n) {
  const std::size_t wanted = static_cast<std::size_t>(n);
  if (view.extent(0) < wanted)
    view = View(Kokkos::ViewAllocateWithoutInitializing(label), wanted + wanted / 2);
}

// Told of each view that on_host gives out: its label and bytes. Where host and device share memory nothing
// is copied, and Kokkos' tools do not see it; tests hold what a step reads.
inline void (*on_host_read)(const char* label, std::size_t bytes) = nullptr;

// A field's host-readable copy (no copy at all where the execution space shares the host's memory).
template <class View>
auto on_host(const View& view) {
  if (on_host_read) on_host_read(view.label().c_str(), view.span() * sizeof(typename View::value_type));
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}

// A named span in the profile: lives as long as the scope.
class TimedRegion {
 public:
  explicit TimedRegion(const char* label) { Kokkos::Profiling::pushRegion(label); }
  ~TimedRegion() { Kokkos::Profiling::popRegion(); }
  TimedRegion(const TimedRegion&) = delete;
  TimedRegion& operator=(const TimedRegion&) = delete;
};

// Ternaries rather than std::min/max: they vectorise and compile for devices.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION constexpr T smaller(T a, T b) {
  return b < a ? b : a;
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION constexpr T larger(T a, T b) {
  return a < b ? b : a;
}

}  // namespace freshet
