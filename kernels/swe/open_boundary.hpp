// Open boundary on a straight line (Vacondio 2010, ch. 4; corrected: SWE-FORMULAS section 9). Outside the line a buffer of
// boundary particles (kind 1) carries the exterior state of each row (strip along the line, one spacing wide): depth from the
// imposed level, velocity from the invariant that leaves the domain. They become fluid as they cross the line, fluid that
// crosses outwards becomes boundary particles, and the buffer is refilled and trimmed at its outer edge.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "cellgrid/sums.hpp"
#include "kernels/swe/motion.hpp"

namespace freshet::swe {

enum class OpenKind { elevation, wave };

template <int D>
struct OpenLine {
  Vec<double, D> origin;   // m, a
  Vec<double, D> inward;   // unit normal towards the water
  Vec<double, D> tangent;  // unit, a -> b (1-D: zero)
  double length;           // m (1-D: 1)
};

struct OpenFlow {
  double inflow = 0, outflow = 0;    // m3 counted as particles cross the line
  double flux = 0, flux_gross = 0;   // m3, time integral of depth x inward velocity (and of its size) along the line
  double straddle0 = 0;              // m3, straddling volume at t = 0
};

template <int D>
class OpenBoundary {
 public:
  static constexpr int fluid = 0, boundary = 1;  // values of the field kind

  OpenBoundary(const OpenLine<D>& line, OpenKind kind, std::function<double(double)> level, double spacing, double eta,
               double gravity);

  // Boundary particles that fill the buffer at level(t = 0), at rest.
  void fill(FieldSet& particles, const std::function<Particles<D>()>& bind, const std::optional<Bed<D>>& bed, int& next_id);

  // Shepard means of level and inward velocity at each row's point on the line, over the fluid within 2h; a row that no
  // fluid reaches keeps its last state.
  void observe(const Rows& rows, const Particles<D>& p, const Field<int>& kind, const std::optional<Bed<D>>& bed);

  // After the drift to time t: exterior states, conversions, removals, insertions. Calls bind() again after growth.
  void exchange(FieldSet& particles, const std::function<Particles<D>()>& bind, const std::optional<Bed<D>>& bed, double t,
                double dt, int& next_id);

  const OpenFlow& flow() const { return flow_; }
  // Volume of the footprints' parts across the line: boundary particles' inside minus fluid's outside [m3].
  double straddling(const Particles<D>& p, const Field<int>& kind, int n) const;

  // Takes the present straddling volume as the start of the account.
  void start(const Particles<D>& p, const Field<int>& kind, int n) { flow_.straddle0 = straddling(p, kind, n); }

  std::vector<double> save() const;
  void restore(const std::vector<double>& state);

 private:
  struct Row {
    double level = 0, speed = 0;        // inner state: level [m], inward velocity [m/s]
    double still = 0;                   // m, level of the water at rest
    double depth = 0, inward = 0;       // exterior state
    double through = 0;                 // m2/s, inward flow per width: across the line
    int observed = 0;
  };

 public:  // device lambdas may not live in private members
  void set_exterior(double t, const std::optional<Bed<D>>& bed);
  void convert(FieldSet& particles, const Particles<D>& p, const std::optional<Bed<D>>& bed);
  void insert(FieldSet& particles, const std::function<Particles<D>()>& bind, const std::optional<Bed<D>>& bed, int& next_id);

 private:
  OpenLine<D> line_;
  OpenKind kind_;
  std::function<double(double)> level_;
  double spacing_, eta_, gravity_, width_, buffer_;
  double summed_;  // what the density summation makes of a depth of 1 on a lattice
  int rows_;
  Kokkos::View<Row*, Memory> row_;
  Field<double> farthest_;  // m, outermost boundary particle of each row
  Field<int> room_;         // boundary particles to insert before each row
  OpenFlow flow_;
  mutable OrderedSums sums_;
};

}  // namespace freshet::swe
