// SISPH formulation L: particles of constant mass m that move with the water, omega = m / H; wet everywhere. One step of theta with
// the geometry at its middle, in Picard passes (H_m: mean of H^n and H^{n+1}, omega_m = m / H_m):
//   v* = v^n - g dt grad eta^n,   v_th = (1 - theta) v^n + theta v*
//   (m_i / H_m^2) d eta_i + sum_j a_ij (d eta_i - d eta_j) = -dt omega_m div v_th + (m_i / H_m^2) rise_i
//   a_ij = g theta^2 dt^2 A_ij / d_ij,   v^{n+1} = v* - g theta dt grad d eta,   H^{n+1} = H^n + d eta - rise
// rise: of the bed below the particle. The matrix acts on the increment alone: its error on disorder is of the order of dt^2 / l and
// no closure is needed. Particles beside the domain keep their state and go on with the velocity they have.
#pragma once
#include <optional>

#include "kernels/bed_spline.hpp"
#include "kernels/linear/cg.hpp"
#include "kernels/linear/particle_mesh.hpp"
#include "kernels/sisph/geometry.hpp"
#include "kernels/sisph/paths.hpp"

namespace freshet::sisph {

struct MovingOptions {
  double gravity = 9.81;  // m/s2
  double theta = 0.55;
  int picard = 2;
  double spacing = 1;     // m
  double h = 1.5;         // m, smoothing length of all
  double support = 2;     // of the kernel, x h
  double held_moment = 1; // s of particles beside the domain
  bool linear = true;     // GeometryRequest::linear
  double cg_tolerance = 1e-6;
  int cg_most = 2000;
  int mesh_from = 15, mesh_until = 3;  // iterations, as SurfaceOptions has them
};

// Sorted particles at time n.
template <int D>
struct Swarm {
  const Rows& rows;
  VecField<double, D> x, v, before;  // m, m/s; before: v^{n-1}, empty where no path needs it
  Field<double> depth, mass, bed;    // m, m^(D+1), m; bed empty where it is flat
  Field<double> h;                   // m
  Field<int> kind;                   // > 0: beside the domain
};

struct MovingReport {
  int solves = 0, iterations = 0, unsettled = 0;
  double least_depth = 0;  // m, at n+1
};

template <int D>
class MovingWater {
 public:
  MovingWater(int particles, const AnyKernel<D>& kernel, const MirrorWalls<D>& walls, const MovingOptions& options);

  // The largest |v_i - v_j| of neighbours [m/s]: what bounds the step. It is part of the restart state.
  double jump() const { return jump_; }
  void set_jump(double jump) { jump_ = jump; }
  void measure_jump(const Swarm<D>& now);
  // Whether the next solve has the particle-mesh correction; likewise.
  bool meshed() const { return mesh_on_; }
  void set_meshed(bool on) { mesh_on_ = on; }

  // From n to n+1; x, v, depth and bed are written, in the order that they are in. Allocates where neighbours outgrow their room.
  MovingReport step(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path, double dt);

 public:  // device lambdas may not live in private members
  void list_pairs(const Swarm<D>& now, double skin);
  void start(const Swarm<D>& now);
  void place(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path, double dt);
  void place_images(const Swarm<D>& now);
  void predict(const Swarm<D>& now, double dt);
  void solve_increment(double dt, bool again, MovingReport& report);
  void lay_mesh(double stiffness);
  linear::CgReport solve_linear(const linear::CgOptions& options, double stiffness);
  void correct(const Swarm<D>& now, double dt);
  double find_jump(const VecField<double, D>& v);
  double arrive(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path, double dt);

 private:
  double reach(double dt, double jump) const;
  void make_room();

  MovingOptions options_;
  Shapes<D> shapes_;
  MirrorWalls<D> walls_;
  Pairs pairs_;
  Geometry<D> g_;
  linear::ConjugateGradients cg_;
  OrderedSums sums_;
  std::optional<linear::ParticleMesh<D>> mesh_;  // of the places at n
  bool mesh_on_ = false, laid_ = false;          // laid: over the places of this step
  Rows rows_;
  Field<double> mesh_mass_, mesh_depth_;         // m^(D-1), m: with the mesh alone
  double jump_ = 0, skin_ = 0;  // m/s; m, by which listed pairs may approach each other
  VecField<double, D> listed_;  // places where pairs were listed, images included
  VecField<double, D> mixed_, star_, end_;  // v_th, v*, v^{n+1}
  Field<double> a_;                         // per pair
  Field<double> inertia_, rise_, last_, change_, right_, diagonal_, inverse_, zero_;  // last: H^{n+1} so far
};

}  // namespace freshet::sisph
