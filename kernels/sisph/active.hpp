// Which slices a step visits: those with water or within a support of water. Water moves no further in one step.
#pragma once
#include "kernels/sisph/geometry.hpp"

namespace freshet::sisph {

template <int D>
class ActiveSlices {
 public:
  explicit ActiveSlices(const Geometry<D>& g);

  // For the depths [m] at the start of a step.
  void find(const Field<double>& depth);
  const SliceList& list() const { return list_; }
  bool drying() const { return dry_ > 0; }  // some particle is dry
  long dry() const { return dry_; }

 private:
  Geometry<D> g_;
  SliceList list_;
  Field<int> near_;  // per slice: holds water or is near it
  int dry_ = 0;
};

}  // namespace freshet::sisph
