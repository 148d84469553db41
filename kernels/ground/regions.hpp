// A value that depends on the place: one of its own inside each polygon (1-D: interval), another elsewhere.
#pragma once
#include "kernels/boundaries/walls/polyline.hpp"

namespace freshet {

struct ValuedRegion {
  Polyline corners;  // m, of a polygon; 1-D: the two ends
  double value;
};

class PlacedValue {
 public:
  PlacedValue(double elsewhere, const std::vector<ValuedRegion>& regions);

  // Where regions overlap the first of them counts.
  template <int D>
  KOKKOS_INLINE_FUNCTION double operator()(const Vec<double, D>& x) const {
    for (int r = 0; r < count_; ++r)
      if (contains(r, x)) return value_(r);
    return elsewhere_;
  }

 private:
  KOKKOS_INLINE_FUNCTION bool contains(int r, const Vec<double, 1>& p) const {
    const double a = x_(first_(r)), b = x_(first_(r) + 1);
    return smaller(a, b) <= p.x && p.x < larger(a, b);
  }
  KOKKOS_INLINE_FUNCTION bool contains(int r, const Vec<double, 2>& p) const {
    bool inside = false;
    const int begin = first_(r), end = first_(r + 1);
    for (int k = begin, before = end - 1; k < end; before = k++)
      inside = inside != crosses_ray({x_(before), y_(before)}, {x_(k), y_(k)}, p);
    return inside;
  }

  int count_;
  double elsewhere_;
  Field<double> x_, y_;  // m, corners of all regions
  Field<int> first_;     // corner of each region; count + 1 entries
  Field<double> value_;
};

}  // namespace freshet
