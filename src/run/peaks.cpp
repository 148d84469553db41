#include "src/run/peaks.hpp"

#include <algorithm>

#include "cellgrid/pack.hpp"
#include "src/run/fastest.hpp"

namespace freshet {
namespace {

// Independent chains enough to hide the latency of two units, few enough for the registers.
constexpr int chains = 16;

struct MultiplyAdd {
  int steps;
  Field<double> out;

  KOKKOS_INLINE_FUNCTION void operator()(int task) const {
    Lane a[chains], factor = 1.0 - 1e-9 * task, shift = 1e-9;
    for (int k = 0; k < chains; ++k) a[k] = Lane(1.0 + k);
    for (int n = 0; n < steps; ++n)
#ifdef __GNUC__
#pragma GCC unroll 16
#endif
      for (int k = 0; k < chains; ++k) a[k] = a[k] * factor + shift;
    double sum = 0;
    for (int k = 0; k < chains; ++k) sum += largest(a[k]);
    out(task) = sum;  // keeps the chains
  }
};

double measure_flops() {
  constexpr int steps = 400000;
  const int tasks = Exec().concurrency();
  const Field<double> out("peaks.out", static_cast<std::size_t>(tasks));
  const double seconds =
      fastest(6, [&] { Kokkos::parallel_for("peaks::multiply_add", Range(0, tasks), MultiplyAdd{steps, out}); });
  return 2.0 * chains * lanes * static_cast<double>(steps) * tasks / seconds;
}

struct Triad {
  Field<double> a, b, c;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const { a(i) = b(i) + 3.0 * c(i); }
};

double measure_bytes() {
  constexpr int n = 8'000'000;
  const Triad triad{Field<double>("peaks.a", n), Field<double>("peaks.b", n), Field<double>("peaks.c", n)};
  const double seconds = fastest(6, [&] { Kokkos::parallel_for("peaks::triad", Range(0, n), triad); });
  return 24.0 * n / seconds;
}

}  // namespace

Peaks measure_peaks() { return {measure_flops(), measure_bytes()}; }

double roof_fraction(double flops_per_s, double bytes_per_s, const Peaks& peaks) {
  return std::max(flops_per_s / peaks.flops, bytes_per_s / peaks.bytes);
}

}  // namespace freshet
