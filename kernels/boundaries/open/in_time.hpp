// Laws of open boundaries whose values follow series of time, on the device: for boundaries that look at
// other times in each place.
#pragma once
#include "kernels/boundaries/open/states.hpp"

namespace freshet {

// Linear between its times, constant before and after; without entries 0.
struct TimeSeries {
  Field<double> t, value;  // s, SI

  KOKKOS_INLINE_FUNCTION double at(double time) const {
    int i = 0, end = t.extent_int(0);
    const int count = end;
    while (i < end) {  // to the first time after
      const int middle = (i + end) / 2;
      if (time < t(middle)) end = middle;
      else i = middle + 1;
    }
    if (count == 0) return 0;
    if (i == 0) return value(0);
    if (i == count) return value(count - 1);
    const double part = (time - t(i - 1)) / (t(i) - t(i - 1));
    return value(i - 1) + part * (value(i) - value(i - 1));
  }
};

// law: with what does not change; first, second: the series of what follows time, as its set() takes them.
struct LawInTime {
  OpenLaw law;
  TimeSeries first, second;
};

}  // namespace freshet
