// The free surface of one Picard pass of particles at rest, docs/formulas/sisph.md (I8) to (I16):
//   V(eta_i) + sum_j a_ij (eta_i - eta_j) = b_i,   V(eta) = omega max(0, eta - bed) (Casulli 2009) a_ij = g
//   theta^2 dt^2 A_ij H_ij / d_ij,  f_ij = A_ij H_ij v_ij . n_ij,  b_i = omega H_i^n - dt sum_j f_ij
// where some f may be cut so that no particle gives more than it has (b >= 0); solved for increments by
// Newton's method, all particles wet in its first solve, with Jacobi CG inside (and the particle mesh, where
// waves cross many particles in a step) and a nonlinear Jacobi step between two solves. The depth follows
// from the fluxes F_ij = f_ij - (a_ij / dt)(eta_j - eta_i), which conserve mass to round-off at any
// tolerance.
#pragma once
#include <optional>

#include "kernels/linear/cg.hpp"
#include "kernels/linear/mesh/particle_mesh.hpp"
#include "kernels/sisph/pairs/coefficients.hpp"

namespace freshet::sisph {

// The layer of water that a step starts from.
template <int D>
struct Layer {
  Field<double> depth;    // m, >= 0
  Field<double> bed;      // m
  VecField<double, D> v;  // m/s
};

struct SurfaceOptions {
  double gravity = 9.81;  // m/s2
  double theta = 0.55;
  double cg_tolerance = 1e-6, newton_tolerance = 1e-6;  // of the residual that the step starts from
  int cg_most = 2000, newton_most = 60;
  // Iterations of a solve above which the next ones have the particle-mesh correction, and of a step's first
  // corrected solve up to which the next ones do without.
  int mesh_from = 15, mesh_until = 3;
};

struct SurfaceReport {
  int newton = 0, iterations = 0;  // linear solves, and CG iterations in all of them
  double residual = 0;             // |b - V(eta) - T eta| at the end, likewise
  bool converged = true;
};

// What coefficients are found from where they are not stored.
template <int D>
struct PairSource {
  AnyKernel<D> kernel;
  double h;              // m, smoothing length, that of all
  Field<double> lambda;  // of the closure (ClosureReport)
};

template <int D>
class FreeSurface {
 public:
  // source: absent = coefficients are stored.
  FreeSurface(const Geometry<D>& g, const Rows& rows, const SurfaceOptions& options,
              const std::optional<PairSource<D>>& source = {});

  // dt gamma of the friction, per particle (friction.hpp); to be asked for before the first step of a scene
  // with friction.
  const Field<double>& make_drag();

  // Whether the next solve has the particle-mesh correction: part of the restart state. The mesh is made when
  // first needed, once.
  bool meshed() const { return mesh_on_; }
  void set_meshed(bool on);

  // Views for the passes around the solve.
  const Field<double>& level() const { return level_; }  // eta as solved for, m: below the bed where dry
  const Field<double>& depth() const {
    return depth_;
  }  // from the fluxes, m: may be negative by the solver's residual
  const AnyPairs<D>& pairs() const { return pairs_; }  // a_ij of the last pass
  const Field<double>& flux() const { return flux_; }  // per pair: f_ij, m3/s

  // Sets the iterate to the surface of the water and the depth to its depth.
  void start(const Layer<D>& water);
  // One Picard pass: coefficients from the mean of the face depths of `water` and of the last pass, then the
  // solve. before: velocity before the pressure at n+1. drying: some particle may be dry.
  SurfaceReport solve(const SliceList& active, const Layer<D>& water, const VecField<double, D>& before,
                      double dt, bool drying);

  // Parts of solve() and of the constructor.
  void level_rows(const SliceList& active, const Layer<D>& water);
  void set_mesh(const SliceList& active, const Layer<D>& water, double stiffness);
  void set_diagonal(const SliceList& active, const Layer<D>& water, bool all_wet);
  void take_source(const PairSource<D>& source);
  void hold_depths(const Layer<D>& water, bool drying);

 private:
  struct Norms {
    double residual, right;
  };
  template <bool drying>
  Norms find_coefficients(const SliceList& active, const Layer<D>& water, const VecField<double, D>& before,
                          double dt);
  template <bool drying>
  AnyPairs<D> recomputed(const Layer<D>& water, double stiffness) const;
  double find_residual(const SliceList& active, const Layer<D>& water);
  int solve_linear(const SliceList& active, const Layer<D>& water, const linear::CgOptions& options,
                   double stiffness);

  Geometry<D> g_;
  Rows rows_;
  SurfaceOptions options_;
  linear::ConjugateGradients cg_;
  std::optional<linear::ParticleMesh<D>> mesh_;
  bool mesh_on_ = false;
  Field<double> wet_, mesh_depth_;  // per particle, for the mesh: omega, or 0 where dry or held; m
  bool first_ = true;               // the next pass is the first of its step
  double scale_ = 1;    // |r| there: what residuals are measured in, whatever the depth below the waves
  Field<double> flux_;  // per pair
  AnyPairs<D> pairs_;
  std::optional<AnyKernel<D>> kernel_;  // where coefficients are not stored, with:
  Places<D> places_;
  Field<double> held_depth_,
      held_last_;  // m, of a pass: the mean of both depths where all is wet, else the depth before
  Field<double> level_, depth_, right_, residual_, change_;  // per particle
  Field<double> row_sum_, diagonal_, inverse_, share_;
  Field<double> drag_;  // empty without friction
};

}  // namespace freshet::sisph
