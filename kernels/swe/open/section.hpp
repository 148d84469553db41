// The rows of an open boundary, piece after piece, and what is imposed on them: the inner states that were
// observed and the law of the boundary's kind give the exterior states. All of it on the device.
#pragma once
#include <vector>

#include "kernels/boundaries/open/states.hpp"

namespace freshet::swe {

// A row's state, on both sides of the line.
struct OpenRow {
  double bed = 0;                            // m, on the line
  double level = 0, speed = 0, slip = 0;     // inner state: level [m], velocity inwards and along [m/s]
  double still = 0;                          // m, level of the water at rest
  double depth = 0, inward = 0, along = 0;   // exterior state: depth [m], velocity inwards and along [m/s]
  double mean_speed = 0, mean_celerity = 0;  // m/s, slow means of u and c of the inner state
  double through = 0;                        // m2/s, inward flow per width: across the line
  int wet = 0;                               // whether fluid was observed
  int closed = 0;                            // whether it is a wall for the fluid
};

using OpenRows = Kokkos::View<OpenRow*, Memory>;

class OpenSection {
 public:
  struct Scales {
    double gravity;  // m/s2
    double least;    // m: thinner water is none
    double memory;   // m: the slow means follow over the time that a wave takes to cross it
  };

  // width: of each row [m].
  OpenSection(const std::vector<double>& width, const Scales& scales);

  OpenRows rows() const { return row_; }
  // The level observed now is that of the water at rest.
  void take_still() const;
  // Exterior states by the law; what passed since the last ones, dt [s] ago, goes to the account.
  void impose(const OpenLaw& law, double dt) const;

  // On the host, for set-up and output.
  std::vector<OpenRow> states() const;
  OpenFlux flux() const;
  void restore(const std::vector<OpenRow>& rows, const OpenFlux& flux);

 public:
  void fill_gaps() const;
  void account(const OpenLaw& law, double dt) const;

 private:
  Scales scales_;
  OpenRows row_;
  Field<double> width_;                            // m
  Kokkos::View<OpenFlux*, Memory> flux_;           // one
  Kokkos::View<DischargeShares*, Memory> shares_;  // one
};

}  // namespace freshet::swe
