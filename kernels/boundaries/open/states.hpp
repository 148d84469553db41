// What each kind of open boundary imposes: the exterior state (depth, inward velocity) from the water before
// the line and the values imposed at a time (Vacondio 2010, (4.2)-(4.4), completed: docs/formulas/swe.md
// (S36) to (S42)). Pure functions. Throughout u is the velocity INTO the domain [m/s], c = sqrt(g d) the
// celerity, and R = -u + 2 c of the inner state the invariant that leaves the domain. Each kind follows the
// local Froude number and the sign of u by itself: what leaves supercritically is copied, and no more than
// critical flow passes where only one value is imposed.
//
// To add a law, write its struct, name it in OpenLaw and write its operator() in laws.hpp. name and title are
// what a scene says and what the program shows, keys(k) tells what a scene gives for it (kernels/choice.hpp),
// values that follow time first in the order in which set() takes them [SI].
#pragma once
#include <variant>

#include "cellgrid/parallel/types.hpp"

namespace freshet {

// The water before one row of the line.
struct InnerState {
  double depth = 0;     // m, 0 = dry
  double inward = 0;    // m/s
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

// What a law of one level has.
struct LevelInTime {
  double level = 0;  // m
  template <class Keys>
  void keys(Keys& k) {
    k.level();
  }
  KOKKOS_INLINE_FUNCTION void set(double level_now, double) { level = level_now; }
};

// Level imposed: d_b = level - bed, u_b = 2 c_b - R (4.2).
struct ImposedLevel : LevelInTime {
  static constexpr const char *name = "elevation", *title = "imposed elevation";
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Level of the incoming wave alone: its invariant u + 2 c = 4 c(level) - 2 c(still) enters, R leaves.
struct IncomingWave : LevelInTime {
  static constexpr const char *name = "wave", *title = "incoming wave";
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Inward velocity imposed: c_b = (R + u_b) / 2 (4.3); 0 is a wall.
struct ImposedVelocity {
  static constexpr const char *name = "velocity", *title = "imposed velocity";
  double inward = 0;  // m/s
  template <class Keys>
  void keys(Keys& k) {
    k.in_time("velocity", "m/s");
  }
  KOKKOS_INLINE_FUNCTION void set(double inward_now, double) { inward = inward_now; }
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Discharge imposed, of which strip.share passes here: 2 c^3 - R c^2 = g q with q = u d; 0 is a wall.
struct ImposedDischarge {
  static constexpr const char *name = "discharge", *title = "imposed discharge";
  double total = 0;       // m3/s (1-D: m2/s), inwards
  bool by_width = false;  // shares in proportion to the width, else to the conveyance
  template <class Keys>
  void keys(Keys& k) {
    k.in_time("discharge", "m3/s");
    k.word("distribute", {"conveyance", "width"}, by_width);
  }
  KOKKOS_INLINE_FUNCTION void set(double total_now, double) { total = total_now; }
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// The state of the water outside: imposed whole where it comes in supercritically; else its invariant u + 2 c
// enters and R leaves. At rest it is a level that waves leave over.
struct ImposedState {
  static constexpr const char *name = "state", *title = "imposed state";
  double stage = 0;        // m, level, or depth
  bool above_bed = false;  // stage is a depth
  double inward = 0;       // m/s
  template <class Keys>
  void keys(Keys& k) {
    k.one_in_time({"level", "depth"}, "m", above_bed);
    k.in_time("velocity", "m/s");
  }
  KOKKOS_INLINE_FUNCTION void set(double stage_now, double inward_now) {
    stage = stage_now, inward = inward_now;
  }
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

// Zero gradient: what enters, u + 2 c, is that of the inner state itself, of which the slow mean keeps the
// scheme's own errors at the line from feeding back; R leaves. Nothing flows in but for as long as a wave's
// trough takes to leave: a mean inflow, which nothing outside would bound, meets water that flows against it
// and ends. Where a level is given, still water of that level lies outside.
struct Transmissive {
  static constexpr const char *name = "transmissive", *title = "transmissive";
  bool levelled = false;
  double level = 0;  // m
  template <class Keys>
  void keys(Keys& k) {
    k.if_given("level", "m", levelled);
  }
  KOKKOS_INLINE_FUNCTION void set(double level_now, double) { level = level_now; }
  KOKKOS_INLINE_FUNCTION ExteriorState operator()(const InnerState& inner, const OpenStrip& strip) const;
};

using OpenLaw =
    std::variant<ImposedLevel, IncomingWave, ImposedVelocity, ImposedDischarge, ImposedState, Transmissive>;

// Depth x inward velocity x width of lines, and its size: of an instant m3/s (1-D: m2/s), summed over time m3
// (m2).
struct OpenFlux {
  double net = 0, gross = 0;
};

ExteriorState exterior_state(const OpenLaw& law, const InnerState& inner, const OpenStrip& strip);

// A row as the distribution of a discharge sees it.
struct Portion {
  double level, bed;  // m, of the water before the row, of the bed on the line
  double width;       // m
  bool wet;
};

// How a discharge is shared among rows, per width [1/m]; the sum of share x width is 1. By conveyance: in
// proportion to the depth^(5/3) under the mean level of the wet rows (the depths of single rows would feed
// back on themselves); equal per width where all rows are dry. Row after row: a line has few.
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

#include "kernels/boundaries/open/laws.hpp"
