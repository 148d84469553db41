// One pass of the step of particles that move: prediction, the system of the correction, and what it changes.
#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "kernels/linear/pair_product.hpp"
#include "kernels/sisph/moving/moving_loops.hpp"

namespace freshet::sisph {

template <int D>
void MovingWater<D>::predict(const Swarm<D>& now, double dt) {
  launch("sisph::predict", Range(0, g_.slices.count),
         Predict<D>{g_, level_, now.drag, now.v, slope_, mixed_, options_.gravity * dt, options_.theta});
  followers_.follow(mixed_);
  g_.images.fill(mixed_);
  g_.images.fill(slope_);
}

// The mesh of the system at hand, over the places at n. It is made when first needed, once.
template <int D>
void MovingWater<D>::lay_mesh(double stiffness) {
  if (!mesh_) mesh_.emplace();
  if (mesh_mass_.extent(0) == 0)
    for (Field<double>* f : {&mesh_mass_, &mesh_depth_})
      *f = Field<double>("sisph.mesh_rows", inertia_.extent(0));
  if (!laid_) mesh_->lay(rows_, listed_, g_.pairs.particles);
  laid_ = true;
  const Geometry<D> g = g_;
  const Field<double> inertia = inertia_, mass = mesh_mass_, depth = mesh_depth_;
  launch(
      "sisph::mesh_rows", Range(0, g.pairs.particles), KOKKOS_LAMBDA(int i) {
        mass(i) = g.free(i) * inertia(i);
        depth(i) = g.omega(i) / inertia(i);
      });
  mesh_->set(mesh_mass_, mesh_depth_, stiffness);
}

template <int D>
linear::CgReport MovingWater<D>::solve_linear(const linear::CgOptions& options, double stiffness) {
  const auto product = [&](const Field<double>& x, const Field<double>& y) {
    return sum_of_slices<1>(
        "sisph::product", g_.slices.count,
        linear::PairProduct<SliceList>{g_.pairs, g_.slices, {a_}, diagonal_, g_.free, x, y})[0];
  };
  // cells of the mesh for a particle: few that have flown far must not make it huge
  constexpr double most = 24;
  const bool suits = linear::MeshCorrection<D>::suits(rows_, g_.pairs.particles, most);
  if (!mesh_on_ || !suits) return cg_.solve(product, linear::Jacobi{inverse_}, right_, correction_, options);
  lay_mesh(stiffness);
  return cg_.solve(product, linear::JacobiPlus<linear::ParticleMesh<D>>{inverse_, *mesh_}, right_,
                   correction_, options);
}

// Returns |b| and |omega|.
template <int D>
std::pair<double, double> MovingWater<D>::set_system(const Swarm<D>& now, double dt, double stiffness) {
  const auto set = [&](const auto& system) {
    const auto squares = sum_of_slices<2>("sisph::increment", g_.slices.count, system);
    return std::pair<double, double>{std::sqrt(squares[0]), std::sqrt(squares[1])};
  };
  const auto with = [&](auto dragged) {
    return Increment<D, decltype(dragged)::value>{
        g_, mixed_, slope_,    level_,   change_,   inertia_,       rise_, now.drag,
        a_, right_, diagonal_, inverse_, stiffness, options_.theta, dt};
  };
  return now.drag.extent(0) > 0 ? set(with(std::true_type{})) : set(with(std::false_type{}));
}

// Residuals are measured in the first right-hand side of the step: later passes have less to do.
template <int D>
void MovingWater<D>::solve_increment(const Swarm<D>& now, double dt, MovingReport& report) {
  constexpr double round_off = 1e-14;  // of omega: water at rest needs no iteration
  const bool again = report.solves > 0;
  const double stiffness = options_.gravity * options_.theta * options_.theta * dt * dt;
  const auto [right, omega] = set_system(now, dt, stiffness);
  linear::CgOptions cg;
  cg.tolerance = options_.cg_tolerance;
  cg.max_iterations = options_.cg_most;
  scale_ = std::max({right, again ? scale_ : 0.0, round_off / cg.tolerance * omega});
  cg.scale = scale_;
  const linear::CgReport solved = solve_linear(cg, stiffness);
  if (solved.iterations > options_.mesh_from || (mesh_on_ && !again))
    set_meshed(solved.iterations > options_.mesh_until);
  ++report.solves;
  report.iterations += solved.iterations;
  report.residual = solved.residual;
  report.solved = solved.converged();
}

template <int D>
void MovingWater<D>::correct(const Swarm<D>& now, double dt) {
  launch("sisph::correct", Range(0, g_.slices.count),
         Correct<D>{g_, correction_, change_, now.depth, rise_, last_, now.drag, slope_, now.v, end_,
                    options_.gravity * dt, options_.theta});
  followers_.follow(end_);
}

// Takes from v^{n+1} the waves between neighbours that neither div nor grad sees: they would stay for good
// and pair particles up.
template <int D>
void MovingWater<D>::even_out(double dt) {
  velocity_gradient<D>(g_, g_.slices, {last_, zero_, end_}, gradient_);
  launch("sisph::even_out", Range(0, g_.slices.count),
         Even<D>{g_, end_, mixed_, gradient_, dt / options_.spacing});
  std::swap(end_, mixed_);
  followers_.follow(end_);
}

template class MovingWater<1>;
template class MovingWater<2>;

}  // namespace freshet::sisph
