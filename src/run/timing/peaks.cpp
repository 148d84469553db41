#include "src/run/timing/peaks.hpp"

#include <algorithm>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/simd/lanes.hpp"
#include "src/run/timing/fastest.hpp"

namespace freshet {
namespace {

#ifdef FRESHET_DEVICE
using Register = double;
constexpr bool many_registers = true;
#else
using Register = pack<double, register_bytes / static_cast<int>(sizeof(double))>;
constexpr bool many_registers = register_bytes == 64;
#endif
constexpr int width = sizeof(Register) / sizeof(double);
// Independent chains: enough to hide the latency of two units, few enough for the registers (AVX-512 has 32,
// AVX2 and SSE 16).
constexpr int chains = many_registers ? 16 : 12;

struct MultiplyAdd {
  int steps;
  Field<double> out;

  KOKKOS_INLINE_FUNCTION void operator()(int task) const {
    Register a[chains], factor = 1.0 - 1e-9 * task, shift = 1e-9;
    for (int k = 0; k < chains; ++k) a[k] = Register(1.0 + k);
    for (int n = 0; n < steps; ++n)
#ifdef __GNUC__
#pragma GCC unroll 16
#endif
      for (int k = 0; k < chains; ++k) a[k] = a[k] * factor + shift;
    Register sum(0.0);
    for (int k = 0; k < chains; ++k) sum += a[k];
    out(task) = largest(sum);  // keeps the chains
  }
};

struct Triad {
  Field<double> a, b, c;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const { a(i) = b(i) + 3.0 * c(i); }
};

double measure_bytes() {
  constexpr int n = 8'000'000;
  const Triad triad{Field<double>("peaks.a", n), Field<double>("peaks.b", n), Field<double>("peaks.c", n)};
  const double seconds = fastest(6, [&] { launch("peaks::triad", Range(0, n), triad); });
  return 24.0 * n / seconds;
}

}  // namespace

double multiply_add_rate(int tasks) {
  constexpr int steps = 400000;
  const Field<double> out("peaks.out", static_cast<std::size_t>(tasks));
  const double seconds = fastest(6, [&] {
    launch("peaks::multiply_add", Range(0, tasks), MultiplyAdd{steps, out});
  });
  return 2.0 * chains * width * static_cast<double>(steps) * tasks / seconds;
}

double clock_rate() {
  constexpr long steps = 20'000'000;
  long sum = 0, one = 1;
  const double seconds = fastest(6, [&] {
    for (long n = 0; n < steps; n += 8)
#ifdef __GNUC__
#pragma GCC unroll 8
#endif
      for (int k = 0; k < 8; ++k) {
        sum += one;
#ifdef __GNUC__
        asm volatile("" : "+r"(sum), "+r"(one));  // neither put together with the next nor a known number
#endif
      }
  });
  return steps / seconds;
}

double allowed_multiply_adds() {
#ifdef FRESHET_DEVICE
  return 0;
#else
  const int of_halves = register_bytes == 64 ? 32 : register_bytes;
  return 2.0 * of_halves / static_cast<int>(sizeof(double)) * (multiplies_and_adds_at_once ? 2 : 1);
#endif
}

Peaks measure_peaks() { return {multiply_add_rate(Exec().concurrency()), measure_bytes()}; }

double roof_fraction(double flops_per_s, double bytes_per_s, const Peaks& peaks) {
  return std::max(flops_per_s / peaks.flops, bytes_per_s / peaks.bytes);
}

}  // namespace freshet
