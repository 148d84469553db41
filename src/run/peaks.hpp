// The machine's limits, measured with the threads at hand: what the rates of a profile or a benchmark are held against.
#pragma once

namespace freshet {

struct Peaks {
  double flops = 0;  // 1/s, double-precision fused multiply-adds in registers, two operations each
  double bytes = 0;  // 1/s, triad a = b + s c from main memory, 24 bytes an element
};

// Takes about 0.4 s and 192 MB.
Peaks measure_peaks();

// The larger share of the two limits that a pass reaches: of the roof over it.
double roof_fraction(double flops_per_s, double bytes_per_s, const Peaks& peaks);

}  // namespace freshet
