// What a scene chooses of each method, and where it splits and merges.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "kernels/boundaries/walls/point.hpp"
#include "kernels/boundaries/walls/wall_kind.hpp"
#include "kernels/fpm/pressure/pressure_scheme.hpp"
#include "kernels/sisph/moving/paths.hpp"
#include "kernels/sisph/velocity/momentum_form.hpp"
#include "kernels/smoothing/smoothing.hpp"
#include "kernels/swe/force/stabilisation.hpp"
#include "src/scene/shapes/function.hpp"

namespace freshet {

enum class Acceleration { classical, variational };

struct Sph {
  double eta = 1.2;  // h / dx
  KernelChoice kernel;
  bool lattice_correction = false;  // the kernel's norm makes its sum over the starting lattice exact
  swe::AnyStabilisation stabilisation = swe::LaxFriedrichsMuscl{};
  Acceleration acceleration = Acceleration::variational;
  double newton_tolerance = 1e-5;  // of the relative density residual
  // x h0; the reader's default is 1.6^(-1/D): what a density 1.6 times the initial one gives
  double h_floor = 0.8;
  double h_cap = 3.0;  // x h0
  WallKind walls = WallKind::automatic;
  bool slip = true;    // walls; false: they also hold the tangential velocity back
  bool mixed = false;  // pairs in single precision, what is made of their sums in double
  // still water over any bed stays at rest to round-off (kernels/swe/force/well_balanced.hpp)
  bool well_balanced = false;
};

// The semi-implicit method.
struct Sisph {
  struct Solver {
    double tolerance;  // of the residual that a step starts from
    int most;          // iterations
  };
  double smoothing = 1.5;  // l / dx
  KernelChoice kernel;
  double theta = 0.55;  // implicitness
  int picard = 2;
  sisph::MomentumForm momentum;
  bool closure = true;  // pair areas closed: sum_j A_ij n_ij = 0
  // for linear fields (Krongauz and Belytschko); false: normalised by Shepard's sum alone
  bool exact_slopes = true;
  // at rest: the coefficients a_ij of the free surface's matrix, in every product, not kept
  bool recomputed = false;
  bool moving = false;  // L: particles move with the water, one mass each; E: they are at rest, wet or dry
  sisph::ParticlePath path;  // moving
  double jump = 0.25;        // moving: |v_i - v_j| dt / dx of neighbours at most
  Solver cg{1e-6, 2000}, newton{1e-6, 60};
  double courant = 1;    // celerity x dt / dx, where the scene names no time.dt
  double viscosity = 0;  // m2/s, lateral, of the depth's mean (at rest)
  bool slip = true;      // walls; false: they hold the tangential velocity, too (with viscosity)
  double advection = 0;  // |v| dt / dx at most; 0 = by the momentum: none (semi-Lagrangian), 0.7 (mass flux)
};

// A limit on the area that a particle covers, in spacing^D; it may differ by region.
struct AreaLimit {
  struct Region {
    std::vector<Point> corners;  // m, of a polygon; 1-D: both ends
    double area;
  };
  std::optional<double> elsewhere;  // absent = no limit there
  std::vector<Region> regions;      // the first that holds a place counts
};

struct Split {
  AreaLimit area;          // a particle that covers this or more is split
  int into = 7;            // daughters: 7 in 2-D, 2 or 3 in 1-D
  double alpha, eps;       // a daughter's h and the pattern's radius, x the parent's h
  double relax = 3;        // h / c: time in which a daughter's h goes to eta (m / depth)^(1/D)
  bool linear = false;     // daughters follow the velocity gradient; else they have the parent's velocity
  double least_depth = 0;  // m
  int most_particles = 20000000;
};

struct Merge {
  AreaLimit area;    // particles that both cover less merge
  double reach = 1;  // x h: how far apart at most
  double relax = 3;  // h / c
};

// The incompressible Finite Pointset Method: a flow in a vertical plane, y upwards.
struct Body {
  std::vector<Point> outline;  // m, counter-clockwise, not closed; empty: a circle
  bool lattice = false;        // the outline is an upright rectangle
  Point centre{};              // m, of the circle
  double radius = 0;
  std::array<Function, 2> velocity;  // m/s; absent = at rest
};

struct Fpm {
  double density = 1000;  // kg/m3
  double viscosity = 0;   // m2/s, kinematic
  Point force{0, -9.81};  // m/s2
  double support = 3.2;   // h0 / dx
  double hole = 0.8;      // x dx: an empty circle larger than this gets a point
  Function grading;       // x dx, the spacing by place: 1 to 4; absent = 1 everywhere
  // each point's support from the number of its neighbours, `support` being that of a lattice
  bool by_neighbours = false;
  fpm::PressureScheme scheme;
  bool implicit_viscosity = false;  // it does not limit the step then
  bool slip = true;                 // walls; false: they also hold the tangential velocity
  double tolerance = 1e-9;          // of the pressure equation
  std::array<bool, 2> periodic{};
  std::vector<Body> bodies;
};

}  // namespace freshet
