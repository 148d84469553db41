// The machine's limits, measured with the threads at hand: what the rates of a profile or a benchmark are
// held against.
#pragma once

namespace freshet {

struct Peaks {
  double flops = 0;  // 1/s, double-precision fused multiply-adds in registers, two operations each
  double bytes = 0;  // 1/s, triad a = b + s c from main memory, 24 bytes an element
};

// Takes about 0.4 s and 192 MB.
Peaks measure_peaks();

// What peaks.flops is made of [1/s]: on so many threads at once, each in registers of the widest kind
// (cellgrid/simd/registers.hpp).
double multiply_add_rate(int tasks);

// The clock [1/s]: whole numbers added one after the other, a cycle each.
double clock_rate();

// Operations a cycle that the width of the registers allows a core with two units for multiply-adds of up to
// 32 bytes, one unit where a multiply-add is two instructions; 64 bytes count as two halves of 32, which is
// what the narrowest of such cores does.
double allowed_multiply_adds();

// The larger share of the two limits that a pass reaches: of the roof over it.
double roof_fraction(double flops_per_s, double bytes_per_s, const Peaks& peaks);

}  // namespace freshet
