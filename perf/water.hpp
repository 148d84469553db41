// Water for benchmarks of single passes: particles of a chosen arrangement, sorted, listed and walled as a
// step does it.
//   uniform    a lattice with every particle moved by up to 0.2 dx
//   graded     dx and h grow by a factor of 5 across the domain, smoothly, along both axes
//   clustered  half of the particles in clumps (ten times as dense, h alike), the others as in uniform
#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "cellgrid/particles/pairs.hpp"
#include "kernels/ground/bed_spline.hpp"
#include "kernels/swe/density/density.hpp"
#include "kernels/swe/density/depth_gradient.hpp"
#include "kernels/swe/force/internal_force.hpp"
#include "kernels/swe/motion.hpp"

namespace freshet::perf {

enum class Arrangement { uniform, graded, clustered };

inline const char* name_of(Arrangement a) {
  return a == Arrangement::uniform ? "uniform" : a == Arrangement::graded ? "graded" : "clustered";
}

// The same numbers everywhere, in [-1, 1).
class Jitter {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
  }

 private:
  unsigned long long state_ = 12345;
};

class Water {
 public:
  static constexpr int D = 2;
  static constexpr double dx = 1, eta = 1.2, depth = 1, margin = 0.05;
  AnyKernel<D> kernel = CubicSpline<D>{};

  Water(Arrangement arrangement, int wanted)
      : side_(std::max(4, static_cast<int>(std::lround(std::sqrt(wanted))))),
        order_(D, dx, {-10 * dx, (side_ + 10) * dx, -10 * dx, (side_ + 10) * dx}) {
    make_fields();
    place(arrangement);
    order_.sort(fields_);
    clusters_.cut(order_.rows());
    list();
    // Densities of the arrangement: a step never starts from worse than what the step before left.
    for (int n = 0; n < 20 && density(1e-10).outgrown > 0; ++n) list();
    list();
    density(1e-10);
    settled_rho_ = copy(bind().rho);
    settled_h_ = copy(bind().h);
    swe::find_depth_gradient<D>(kernel, clusters_, neighbours_.view(), bind());
  }

  int size() const { return fields_.size(); }
  double pairs() const {
    const auto p = bind();
    return neighbours_.count_pairs<D>(clusters_, {p.x, p.h, order_.rows(), p.x, p.h, 2.0, 0});
  }
  double listed() const { return neighbours_.mean_length(clusters_) * clusters_.size() * lanes; }

  // ---- The passes
  // -------------------------------------------------------------------------------------------------------
  void sort() {
    order_.sort(fields_);
    clusters_.cut(order_.rows());
  }
  ListRequest<D> listing() const {
    const auto p = bind();
    return {p.x, p.h, order_.rows(), p.x, p.h, 2.0, margin};
  }
  void list() {
    order_.measure_reach(fields_, bind().h, 2 * (1 + margin));
    neighbours_.build<D>(clusters_, listing());
  }
  swe::DensityReport density(double tolerance = 1e-5) {
    swe::DensityOptions options{};
    options.gravity = gravity;
    options.tolerance = tolerance;
    options.margin = margin;
    options.bounds = {0.3, 3};
    options.gradient = true;
    options.imposed_alpha = 1;
    options.ahead = 0.5;
    return swe::solve_density<D>(kernel, clusters_, neighbours_.view(), walls(), bind(), {}, options);
  }
  void force(const swe::AnyStabilisation& stabilise) {
    swe::internal_force<D>(kernel, clusters_, neighbours_.view(), walls(), bind(), stabilise);
  }
  void kick_and_drift(double dt) { swe::kick_and_drift<D>(bind(), motion(), size(), dt); }
  double accelerate(double dt) { return swe::accelerate_and_kick<D>(bind(), motion(), size(), dt); }
  // y = 20 x - sum of the neighbours' x: a matrix as a pressure equation has it.
  void multiply() {
    const PairView pairs = pairs_.view();
    const Field<double> a = coefficient_, x = vector_x_, y = vector_y_;
    Kokkos::parallel_for(
        "perf::matvec", Range(0, pairs.slices()), KOKKOS_LAMBDA(int s) {
          const Lanes me = pairs(s);
          me.store(y, 20.0 * me.load(x) - pairs.weighted_sum(s, a, x));
        });
  }
  double entries() const { return static_cast<double>(pairs_.entries()) * lanes; }
  void find_walls() { walls_->find(clusters_, listing(), neighbours_.view()); }
  void reflect() { walls_->reflect(clusters_, bind().x, bind().v, bind().v_pred); }

  // ---- What passes need
  // ------------------------------------------------------------------------------------------------- The
  // guess that a prediction leaves: 0.2 % off, one side or the other.
  void disturb_density() {
    const auto p = bind();
    const Field<double> rho = settled_rho_, h = settled_h_;
    Kokkos::parallel_for(
        "perf::disturb", Range(0, size()), KOKKOS_LAMBDA(int i) {
          p.rho(i) = rho(i) * (1 + 2e-3 * ((i * 2654435761u >> 16) % 201 * 0.01 - 1));
          p.h(i) = h(i);
        });
  }
  // To and fro by up to 0.02 dx: as far as particles go in a step.
  void stir() {
    stirred_ = -stirred_;
    const auto p = bind();
    const double step = 0.02 * dx * stirred_;
    Kokkos::parallel_for(
        "perf::stir", Range(0, size()), KOKKOS_LAMBDA(int i) {
          const unsigned id = static_cast<unsigned>(p.id(i));
          p.x.x(i) += step * ((id * 2654435761u >> 16) % 201 * 0.01 - 1);
          p.x.y(i) += step * ((id * 2246822519u >> 16) % 201 * 0.01 - 1);
        });
  }
  void add_bed() {
    const double size = side_ * dx, wave = 20 * dx;
    const auto level = [=](double x, double y) {
      return 0.05 * wave * std::sin(x / wave) * std::cos(y / wave);
    };
    bed_ = swe::BedTerm<D>{BedSpline<D>(level, {{0, 0}, {size, size}, dx, 0}), true,
                           fields_.real("bed", "m", Carry::no)};
  }
  void add_matrix() {
    const auto p = bind();
    pairs_.build<D>(size(), {order_.rows(), p.x, p.h, 2.0});
    coefficient_ = pairs_.coefficient("perf.a");
    Kokkos::deep_copy(coefficient_, 1.0);
    vector_x_ = copy(p.rho);
    vector_y_ = copy(p.rho);
  }
  void add_friction() {
    friction_ = swe::Friction{gravity, 0.02};
    drag_ = fields_.real("drag", "1/m", Carry::no);
  }
  void add_walls(WallKind kind) {
    const double size = side_ * dx;
    walls_.emplace(std::vector<Polyline>{{{0, 0}, {size, 0}, {size, size}, {0, size}, {0, 0}}},
                   WallOptions{kind, dx, 1.5 * 2 * eta * dx, true}, std::array<double, 2>{size / 2, size / 2},
                   2.0);
    find_walls();
  }

 private:
  static constexpr double gravity = 9.81;

  void make_fields() {
    fields_ = FieldSet(side_ * side_);
    for (const char* name : {"x", "y", "u", "v", "mass", "h0", "kh", "depth", "h"})
      fields_.real(name, "1", Carry::sort);
    for (const char* name : {"u_pred", "v_pred", "ax", "ay", "tx", "ty", "depth_rate", "depth_growth",
                             "inv_h", "pressure", "celerity", "weight", "signal", "strain_xx", "strain_xy",
                             "strain_yy", "depth_slope_x", "depth_slope_y"})
      fields_.real(name, "1", Carry::no);
    fields_.integer("id", "1", Carry::sort);
  }

  // Where the node s of n lies, and the spacing there, both for spacings that grow from dx/5^(1/2) to dx
  // 5^(1/2).
  static std::array<double, 2> graded(double s, int n) {
    const double rate = std::log(5.0) / n, first = 1 / std::sqrt(5.0);
    return {dx * first * (std::exp(rate * s) - 1) / rate, dx * first * std::exp(rate * s)};
  }

  void place(Arrangement arrangement) {
    const auto p = bind();
    Jitter jitter;
    const int clump = 10;  // lattice cells across, half of them in dense clumps
    for (int k = 0; k < size(); ++k) {
      const int i = k % side_, j = k / side_;
      std::array<double, 2> x{(i + 0.5) * dx, dx}, y{(j + 0.5) * dx, dx};
      if (arrangement == Arrangement::graded) x = graded(i + 0.5, side_), y = graded(j + 0.5, side_);
      double spacing = arrangement == Arrangement::graded ? std::sqrt(x[1] * y[1]) : dx;
      if (arrangement == Arrangement::clustered && (i / clump + j / clump) % 2 == 0) {
        spacing = dx / std::sqrt(10.0);
        x[0] = (i / clump * clump + 0.5 * clump) * dx + (i % clump + 0.5 - 0.5 * clump) * spacing;
        y[0] = (j / clump * clump + 0.5 * clump) * dx + (j % clump + 0.5 - 0.5 * clump) * spacing;
        x[1] = y[1] = spacing;
      }
      put(p.x, k, {x[0] + 0.2 * x[1] * jitter(), y[0] + 0.2 * y[1] * jitter()});
      put(p.v, k, {0.1 * jitter(), 0.1 * jitter()});
      put(p.v_pred, k, at(p.v, k));
      p.m(k) = depth * x[1] * y[1];
      p.h0(k) = p.h(k) = eta * spacing;
      p.kh(k) = depth * eta * eta * x[1] * y[1];
      p.rho(k) = depth;
      p.id(k) = k;
    }
  }

  static Field<double> copy(const Field<double>& field) {
    Field<double> other("perf.copy", field.extent(0));
    Kokkos::deep_copy(other, field);
    return other;
  }

  WallView<D> walls() const { return walls_ ? walls_->view() : WallView<D>{}; }
  swe::MotionOptions<D> motion() const {
    return {gravity, {0.3, 3}, bed_, friction_, drag_, {}, walls_.has_value()};
  }

  swe::Particles<D> bind() const {
    const FieldList list = FieldList::binding(fields_);
    swe::Particles<D> p;
    p.declare(list);
    p.declare_strain(list, false);
    p.declare_depth_slope(list);
    return p;
  }

  int side_;
  FieldSet fields_;
  RowOrder order_;
  ClusterSet clusters_;
  NeighbourList neighbours_;
  Field<double> settled_rho_, settled_h_, drag_, coefficient_, vector_x_, vector_y_;
  Pairs pairs_;
  std::optional<swe::BedTerm<D>> bed_;
  std::optional<swe::Friction> friction_;
  std::optional<Walls<D>> walls_;
  double stirred_ = 1;
};

}  // namespace freshet::perf
