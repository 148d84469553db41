// What the run loop needs of a method: the only virtual interface between solvers and the program.
#pragma once
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cellgrid/parallel/work.hpp"
#include "cellgrid/particles/order.hpp"
#include "kernels/water/wet_levels.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

// Water volumes; 1-D scenes have unit width.
struct Totals {
  double mass = 0;  // m3, fluid particles only
  // m3 entered through open boundaries since t = 0 (particles counted as they cross the line)
  double inflow = 0;
  double outflow = 0;  // m3 left
  double flux = 0;  // m3, time integral of depth x inward normal velocity along the open lines; NaN: unknown
  double flux_gross = 0;  // m3, the same with |normal velocity|
  // m3, change since t = 0 of the part of particles' footprints that lies across the line
  double straddle = 0;
};

// Momentum and energy of the fluid per unit density of water.
struct Mechanics {
  std::array<double, 2> momentum{};  // m4/s
  double kinetic = 0;                // m5/s2
  double potential = 0;              // m5/s2, of the column's middle above z = 0
};

// Shallow water at a fixed point: Shepard mean over the fluid particles within 2h.
struct PointState {
  double bed = 0;        // m
  double depth = 0;      // m, 0 if no particle reaches the point
  bool reached = false;  // some particle's support covers it
};

constexpr double dry_depth = 1e-4;  // m: a place with less water shows the bed's level, marked dry

// What a gauge reads, in the unit of its measurand: base + value where there is water, else the base. Between
// two steps base and value are interpolated; a value that comes out below `film` is no water.
struct Reading {
  double value = 0;
  double base = 0;  // m, the bed below an elevation; else 0
  bool wet = false;
  double film = -std::numeric_limits<double>::infinity();
};

// How the numerics of the last step fared.
struct StepReport {
  double newton_mean = 0;  // density iterations per cluster
  int newton_max = 0;
  long rebuilds = 0;            // neighbour lists made again because h outgrew the margin, since t = 0
  int capped = 0, floored = 0;  // particles whose h sits at its bounds
  // Implicit methods, since t = 0: passes for the surface, linear solves in them, iterations of those, passes
  // that did not settle.
  long passes = 0, solves = 0, iterations = 0, unsettled = 0;
  int pressure_iterations = 0;  // of the incompressible methods
};

// Scalars that a method must find again on resume, by name.
using ScalarState = std::map<std::string, std::vector<double>>;

class Method {
 public:
  virtual ~Method() = default;

  virtual std::string name() const = 0;
  virtual int dimension() const = 0;
  virtual double stable_dt() const = 0;        // s, for the state at hand
  virtual void step(double t, double dt) = 0;  // from t to t + dt
  // Fields of every method: x, y [m], u, v [m/s], id (int). 1-D has no y, v.
  // Shallow water: depth [m], bed [m] (not where it is flat), mass [m3], h [m], kind (int, only with open
  // boundaries: 0 fluid, > 0 boundary particle of that piece of line). Incompressible: p [Pa], surface (int,
  // 1 on the free surface).
  virtual FieldSet& fields() = 0;
  virtual const FieldSet& fields() const = 0;
  virtual const Rows& rows() const = 0;  // the order that the particles are in, with the reach of their h
  virtual Totals totals() const = 0;
  virtual Mechanics mechanics() const = 0;
  virtual StepReport report() const = 0;
  // Modelled work of one launch, by label, for the state at hand; a method may leave some or all of its
  // launches out.
  virtual std::map<std::string, Work> work() const { return {}; }
  // What only shallow water has; other scenes do not ask for it.
  virtual std::vector<PointState> sample(const std::vector<Point>& points) const {
    return std::vector<PointState>(points.size());
  }
  // What each gauge shows; here elevations, which every method has.
  virtual std::vector<Reading> read(const std::vector<Gauge>& gauges) const {
    std::vector<Point> points;
    for (const Gauge& g : gauges) points.push_back(g.at);
    std::vector<Reading> readings;
    for (const PointState& s : sample(points)) readings.push_back({s.depth, s.bed, s.reached, dry_depth});
    return readings;
  }
  // Raises what each shore has seen so far to the highest of its water now; nothing is copied to the host.
  virtual void raise_wet_levels(const Shores&) const {}
  virtual std::vector<std::string> features()
      const = 0;  // what this scene switched on, for `check` and the log

  // What the method did beyond its recipe since t = 0, for the end of the log and the summary's warnings.
  virtual std::vector<std::string> notes() const { return {}; }

  virtual ScalarState scalars() const = 0;  // with the saved fields (is_saved):
  virtual void restore(
      const ScalarState& scalars) = 0;  // the whole state. Fields are filled before restore() is called.
};

// The method that the scene names; throws SceneError for an unknown name (src/run/make_method.cpp).
std::unique_ptr<Method> make_method(const Scene& scene);

}  // namespace freshet
