// What the laws of the open boundaries make of the water before each place of the rim (open.hpp); on the
// device.
#pragma once
#include <vector>

#include "kernels/boundaries/open/in_time.hpp"

namespace freshet::sisph {

struct RimRecord {
  int opening;
  double outside, width;  // m, behind the line; of the line that it stands for
  double bed, still;      // m, and depth at rest
  double n2;              // s2/m^(2/3), of friction
};

// Of each place.
struct RimFeet {
  Field<double> depth, out;  // m, m/s: of the water before it
  Field<double> next_depth;  // m, at n+1
};

class RimLaws {
 public:
  // by_width: every discharge is.
  RimLaws(std::vector<LawInTime> laws, const std::vector<RimRecord>& places, double gravity, double spacing,
          bool by_width);

  // From depth and v.n at the feet to those at t + dt: out is written over.
  void find(const RimFeet& feet, double t, double dt) const;

  // Slow means of v.n and c at the feet: part of the restart state.
  std::vector<double> means() const;
  void set_means(const std::vector<double>& means);

 public:
  void share(int opening, bool by_width, const Field<double>& foot_depth) const;

 private:
  double gravity_, spacing_;
  bool by_width_;
  std::vector<LawInTime> laws_;
  Kokkos::View<RimRecord*, Memory> place_;
  Field<double> mean_out_, mean_celerity_;         // m/s
  Kokkos::View<DischargeShares*, Memory> shares_;  // one: of the opening at hand
};

}  // namespace freshet::sisph
