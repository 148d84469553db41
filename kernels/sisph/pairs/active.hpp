// Which slices a step visits: those with water or within some supports of water. Water moves one support in
// each Picard pass.
#pragma once
#include "kernels/sisph/pairs/geometry.hpp"

namespace freshet::sisph {

template <int D>
class ActiveSlices {
 public:
  explicit ActiveSlices(const Geometry<D>& g);

  // For the depths [m] at the start of a step.
  void find(const Field<double>& depth, int supports);
  const SliceList& list() const { return list_; }
  bool drying() const { return dry_ > 0; }  // some particle is dry
  long dry() const { return dry_; }

 public:
  void number_slices();

 private:
  Geometry<D> g_;
  SliceList list_;
  Field<int> near_;   // per slice: 1 = holds water, n + 1 = within n supports of it, 0 = further away
  Field<int> slice_;  // per particle: its slice
  int dry_ = 0;
};

}  // namespace freshet::sisph
