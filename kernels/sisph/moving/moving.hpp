// SISPH formulation L (docs/formulas/sisph.md (I32) to (I35)): particles of constant mass m that move with
// the water, omega = m / H; wet everywhere. One step of theta with the geometry at its middle, in Picard
// passes (H_m: mean of H^n and H^{n+1}, omega_m = m / H_m, eta_th = eta^n + theta d eta):
//   v_th = (1 - theta) v^n + theta v^{n+1},   v^{n+1} = (v^n - g dt grad eta_th) / (1 + gamma)
//   (m_i / H_m^2) d eta_i = -dt omega_m div v_th + sum_j (a_ij / theta) [eta_j - eta_i - d_ij n_ij.(grad
//   eta_i + grad eta_j) / 2]_th
//                           + (m_i / H_m^2) rise_i,         a_ij = g theta^2 dt^2 A_ij / d_ij / (1 +
//                           gamma_ij)
// rise: of the bed below the particle; gamma: dt x friction. Each pass corrects d eta by one solve with m_i /
// H_m^2 and a_ij. The bracket is a third difference (Rhie and Chow's; in SPH Antuono et al. 2010): it
// vanishes for any plane surface on any particles, and on a lattice it makes what div grad does not see of
// short waves part of the matrix. Without it v^{n+1} keeps (1 - (k_div grad / k)^2) of what grad eta^n pushes
// such waves, more the longer the step, and particles in disorder have modes that grow. No closure is needed.
// Third differences of v^{n+1} are taken from it: waves between neighbours that neither div nor grad sees
// pair the particles up.
#pragma once
#include <optional>

#include "kernels/ground/bed_spline.hpp"
#include "kernels/linear/cg.hpp"
#include "kernels/linear/mesh/particle_mesh.hpp"
#include "kernels/linear/pair_product.hpp"
#include "kernels/sisph/moving/followers.hpp"
#include "kernels/sisph/moving/paths.hpp"
#include "kernels/sisph/pairs/geometry.hpp"
#include "kernels/sisph/particles.hpp"
#include "kernels/sisph/velocity/gradient.hpp"

namespace freshet::sisph {

struct MovingOptions {
  double gravity = 9.81;  // m/s2
  double theta = 0.55;
  int picard = 2;
  double spacing = 1;      // m
  double h = 1.5;          // m, smoothing length of all
  double support = 2;      // of the kernel, x h
  double held_moment = 1;  // s of particles beside the domain
  bool linear = true;      // GeometryRequest::linear
  double cg_tolerance = 1e-6;
  int cg_most = 2000;
  int mesh_from = 15, mesh_until = 3;  // iterations, as SurfaceOptions has them
};

// Sorted particles at time n.
template <int D>
struct Swarm : WaterFields<D> {
  const Rows& rows;
  Field<double> drag;  // dt gamma; empty without friction
};

// What a step would come to.
struct MovingReport {
  int solves = 0, iterations = 0;  // one solve a pass
  bool solved = true;              // every linear system
  double residual = 0;             // of the last one, of its right-hand side
  double least_depth = 0;          // m, at n+1
  double jump = 0;                 // m/s, largest |v_i - v_j| of neighbours at n+1
  bool holds() const { return solved && least_depth > 0; }
};

template <int D>
class MovingWater {
 public:
  MovingWater(int particles, const AnyKernel<D>& kernel, const MirrorWalls<D>& walls,
              const MovingOptions& options);

  // The largest |v_i - v_j| of neighbours [m/s]: what bounds the step. It is part of the restart state.
  double jump() const { return jump_; }
  void set_jump(double jump) { jump_ = jump; }
  void measure_jump(const Swarm<D>& now);
  // Whether the next solve has the particle-mesh correction; likewise.
  bool meshed() const { return mesh_on_; }
  void set_meshed(bool on) { mesh_on_ = on; }
  // Of a product of CG with its matrix.
  Work product_work() const { return linear::work_of_slices(linear::product_cost, g_.pairs, g_.slices); }
  // Who beside the domain goes with whom.
  void set_followers(const Followers<D>& followers) { followers_ = followers; }

  // What the step from n to n+1 comes to; the particles stay as they are. Allocates where neighbours outgrow
  // their room.
  MovingReport attempt(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path, double dt);
  // Takes the step that was tried last: x, v, depth and bed are written, in the order that they are in.
  void arrive(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path, double dt);

 public:
  void list_pairs(const Swarm<D>& now, double skin);
  void visit_all(int slices);
  void start(const Swarm<D>& now);
  void place(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path, double dt);
  void place_images(const Swarm<D>& now);
  void find_levels(const Swarm<D>& now);
  void predict(const Swarm<D>& now, double dt);
  void solve_increment(const Swarm<D>& now, double dt, MovingReport& report);
  std::pair<double, double> set_system(const Swarm<D>& now, double dt, double stiffness);
  void lay_mesh(double stiffness);
  linear::CgReport solve_linear(const linear::CgOptions& options, double stiffness);
  void correct(const Swarm<D>& now, double dt);
  void even_out(double dt);
  double find_jump(const VecField<double, D>& v);
  double find_least_depth();

 private:
  double reach(double dt, double jump) const;
  void make_room();

  MovingOptions options_;
  Shapes<D> shapes_;
  MirrorWalls<D> walls_;
  Pairs pairs_;
  ImageLists<D> image_lists_;
  Geometry<D> g_;
  Followers<D> followers_;
  linear::ConjugateGradients cg_;
  std::optional<linear::ParticleMesh<D>> mesh_;  // of the places at n
  bool mesh_on_ = false, laid_ = false;          // laid: over the places of this step
  Rows rows_;
  Field<double> mesh_mass_, mesh_depth_;     // m^(D-1), m: with the mesh alone
  double jump_ = 0, tried_ = 0;              // m/s, at n and at n+1 as far as it is known
  double skin_ = 0;                          // m, by which listed pairs may approach each other
  double scale_ = 0;                         // of the first right-hand side of the step
  VecField<double, D> listed_;               // places where pairs were listed, images included
  VecField<double, D> mixed_, slope_, end_;  // v_th, grad eta_th, v^{n+1}
  VelocityGradient<D> gradient_;             // of v^{n+1}
  Field<double> a_;                          // per pair
  Field<double> inertia_, rise_, last_, level_, change_,
      correction_;  // last: H^{n+1} so far; level: eta_th; change: d eta so far
  Field<double> right_, diagonal_, inverse_, zero_;
};

}  // namespace freshet::sisph
