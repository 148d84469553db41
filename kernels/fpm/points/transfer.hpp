// Fields at new places by moving least squares over the points around them (thesis 5.3.3): the fitted value
// of every carried field, held within the range of the values around it and a part of that beyond.
#pragma once
#include <string>
#include <vector>

#include "cellgrid/particles/fields.hpp"
#include "cellgrid/particles/near.hpp"
#include "kernels/fpm/stencils/mls.hpp"

namespace freshet::fpm {

class Transfer {
 public:
  // Finds the factors of the places 0 ... count - 1 [m] for points within h [m] of each.
  void find(const Near& near, const VecField<double, 2>& places, const Field<double>& h, int count);

  // value(k) = the field's fitted value at place k, at most slack(k) of the range outside it: what is
  // extrapolated by more, again and again, grows (points at the end of a film on a wall: e-fold in 0.05 s).
  void apply(const Field<double>& field, const Field<double>& value, const Field<double>& slack) const;

 private:
  Near near_;
  VecField<double, 2> places_;
  Kokkos::View<Terms<double, 2>*, Memory> factors_;
  Field<double> h_;
  int count_ = 0;
};

}  // namespace freshet::fpm
