// Open boundary: one or more straight pieces that share what is imposed (a total discharge, say), and the
// account of the water that passed. Each step: inner states are observed, the law of the kind gives the
// exterior states, the buffers apply them.
#pragma once
#include "kernels/boundaries/open/states.hpp"
#include "kernels/swe/open/buffer.hpp"

namespace freshet::swe {

struct OpenFlow {
  double inflow = 0, outflow = 0;  // m3 counted as particles cross the line
  double flux = 0,
         flux_gross = 0;  // m3, time integral of depth x inward velocity (and of its size) along the line
  double straddle0 = 0;   // m3, straddling volume at t = 0
};

template <int D>
class BufferedLine {
 public:
  using Ground = std::optional<BedTerm<D>>;

  // law(t): what is imposed at time t [s]; it is linear between the times given. first_owner: the first of
  // the numbers > 0 for the field kind, one per piece.
  BufferedLine(const std::vector<OpenLine<D>>& pieces, std::function<OpenLaw(double)> law,
               const std::vector<double>& times, const OpenBufferOptions& options, double gravity,
               int first_owner);

  // Fills the buffers with the exterior state that belongs to the water as it was placed. Needs the order of
  // the particles.
  void fill(const Rows& rows, FieldSet& particles, const Bind<D>& bind, const Ground& bed, int& next_id);

  // Takes the present level as that at rest and the present straddling volume as the start of the account.
  void start(const Particles<D>& p, const Field<int>& kind, int n);

  void observe(const Rows& rows, const Particles<D>& p, const Field<int>& kind, const Ground& bed);

  // After the drift to time t: exterior states, conversions, removals, insertions. Calls bind() again after
  // growth.
  void exchange(FieldSet& particles, const Bind<D>& bind, const Ground& bed, double t, double dt,
                int& next_id);

  // Least time [s] in which what enters dry land crosses h: until it has entered, no particle tells the time
  // step of it.
  double crossing_time() const { return crossing_time_; }

  OpenFlow flow() const;
  double straddling(const Particles<D>& p, const Field<int>& kind, int n) const;  // m3
  int pieces() const { return static_cast<int>(buffers_.size()); }

  std::vector<double> save() const;
  void restore(const std::vector<double>& state);

 private:
  void foresee();

  std::function<OpenLaw(double)> law_;
  std::vector<double> times_;
  double gravity_;
  std::vector<OpenBuffer<D>> buffers_;
  OpenSection section_;
  double crossing_time_ = 1e300;
  OpenFlow flow_;  // without the fluxes, which the section accounts for
};

}  // namespace freshet::swe
