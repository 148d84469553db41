// What each kind of open boundary imposes: the exterior state (depth, inward velocity) from the water before the line and the
// values imposed at a time (Vacondio 2010, (4.2)-(4.4); corrected and completed: SWE-FORMULAS section 9). Pure functions.
// Throughout u is the velocity INTO the domain [m/s], c = sqrt(g d) the celerity, and R = -u + 2 c of the inner state the
// invariant that leaves the domain. Each kind follows the local Froude number and the sign of u by itself:
// what leaves supercritically is copied, and no more than critical flow passes where only one value is imposed.
#pragma once
#include <variant>

#include "cellgrid/types.hpp"

namespace freshet {

// The water before one row of the line.
struct InnerState {
  double depth = 0;   // m, 0 = dry
  double inward = 0;  // m/s
  double arriving = 0;  // m/s, -|u| + 2 c of the slow means
};

// One row of the line.
struct OpenStrip {
  double gravity;    // m/s2
  double bed;        // m
  double still = 0;  // m, depth of the water at rest
  double share = 0;  // 1/m, the part of the total discharge that passes here, per width
};

struct ExteriorState {
  double depth = 0;     // m
  double inward = 0;    // m/s
  bool closed = false;  // nothing passes: a reflecting wall for the water inside
};

// Level imposed: d_b = level - bed, u_b = 2 c_b - R (4.2).
struct ImposedLevel {
  double level;  // m
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Level of the incoming wave alone: its invariant u + 2 c = 4 c(level) - 2 c(still) enters, R leaves.
struct IncomingWave {
  double level;  // m
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Inward velocity imposed: c_b = (R + u_b) / 2 (4.3); 0 is a wall.
struct ImposedVelocity {
  double inward;  // m/s
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Discharge imposed, of which strip.share passes here: 2 c^3 - R c^2 = g q with q = u d; 0 is a wall.
struct ImposedDischarge {
  double total;   // m3/s (1-D: m2/s), inwards
  bool by_width;  // shares in proportion to the width, else to the conveyance
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// The state of the water outside: imposed whole where it comes in supercritically; else its invariant u + 2 c enters and R
// leaves. At rest it is a level that waves leave over.
struct ImposedState {
  double stage;         // m, level, or depth
  bool above_bed;       // stage is a depth
  double inward = 0;    // m/s
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Zero gradient: what enters, u + 2 c, is that of the inner state itself, of which the slow mean keeps the scheme's own errors
// at the line from feeding back; R leaves. Nothing flows in but for as long as a wave's trough takes to leave: a mean inflow,
// which nothing outside would bound, meets water that flows against it and ends.
struct Transmissive {
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

using OpenLaw = std::variant<ImposedLevel, IncomingWave, ImposedVelocity, ImposedDischarge, ImposedState, Transmissive>;

ExteriorState exterior_state(const OpenLaw& law, const InnerState& inner, const OpenStrip& strip);

// A row as the distribution of a discharge sees it.
struct Portion {
  double level, bed;  // m, of the water before the row, of the bed on the line
  double width;       // m
  bool wet;
};

// How a discharge is shared among rows, per width [1/m]; the sum of share x width is 1. By conveyance: in proportion to the
// depth^(5/3) under the mean level of the wet rows (the depths of single rows would feed back on themselves); equal per width
// where all rows are dry. Row after row: a line has few.
class DischargeShares {
 public:
  DischargeShares() = default;
  // portion(r) for r < rows
  template <class Portions>
  KOKKOS_INLINE_FUNCTION DischargeShares(int rows, const Portions& portion, bool by_width) {
    double wet_width = 0, level = 0;
    width_ = 0;
    for (int r = 0; r < rows; ++r) {
      const Portion p = portion(r);
      width_ += p.width;
      if (p.wet) wet_width += p.width, level += p.width * p.level;
    }
    if (by_width || wet_width == 0) return;
    level_ = level / wet_width;
    for (int r = 0; r < rows; ++r) conveyance_ += conveyance(portion(r)) * portion(r).width;
  }

  KOKKOS_INLINE_FUNCTION double of(const Portion& row) const {
    return conveyance_ > 0 ? conveyance(row) / conveyance_ : 1 / width_;
  }

 private:
  KOKKOS_INLINE_FUNCTION double conveyance(const Portion& row) const {
    return ::pow(larger(0.0, level_ - row.bed), 5.0 / 3);
  }

  double width_ = 1, level_ = 0, conveyance_ = 0;  // conveyance_ 0: equal per width
};

}  // namespace freshet

#include "kernels/open/laws.hpp"
