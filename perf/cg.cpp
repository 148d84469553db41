// perf_cg [particles]: the free-surface solver's parts from memory: triad, matrix product over stored pairs (SELL-W), a whole CG
// iteration with Jacobi and with the particle-mesh preconditioner; GB/s modelled, and as a share of the triad measured in the same
// run. Then iterations and seconds of a solve to 1e-8 by celerity Courant number. Particles: a lattice moved by up to 0.2 dx.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "cellgrid/runtime.hpp"
#include "kernels/linear/cg.hpp"
#include "kernels/linear/pair_product.hpp"
#include "kernels/linear/particle_mesh.hpp"
#include "src/run/fastest.hpp"
#include "src/run/peaks.hpp"

namespace {

using namespace freshet;
using linear::CgReport;
using linear::Vector;

struct AllSlices {
  KOKKOS_FORCEINLINE_FUNCTION int operator()(int k) const { return k; }
};

// omega x_i + sum_j a_ij (x_i - x_j), a_ij = k omega^2 w_ij (1/s_i + 1/s_j), s_i = sum_j omega w_ij d_ij^2 / 2: water 1 m deep.
class System {
 public:
  explicit System(int wanted) : side_(static_cast<int>(std::lround(std::sqrt(wanted)))), fields_(side_ * side_), order_(2, 1.0) {
    place();
    order_.sort(fields_);
    x_ = {fields_.real("x"), fields_.real("y")};
    order_.measure_reach(fields_, fields_.real("h"), 2.0);
    pairs_.build<2>(size(), {order_.rows(), x_, fields_.real("h"), 2.0});
    for (Vector* v : {&diagonal_, &inverse_, &mass_, &depth_, &right_, &found_, &result_})
      *v = Vector("perf.vector", static_cast<size_t>(size()) + lanes);
    a_ = pairs_.coefficient("perf.a");
    linear::fill(size(), 1.0, mass_);
    linear::fill(size(), 1.0, depth_);
    for (int i = 0; i < size(); ++i) {
      const double s = side_, along = x_.x(i) / s - 0.4, across = x_.y(i) / s - 0.5;
      right_(i) = std::exp(-30 * along * along - 20 * across * across) + 0.05 * std::sin(12.9898 * i);
    }
    mesh_.lay(order_.rows(), x_, size());
    cg_.resize(size());
  }

  int size() const { return fields_.size(); }
  int entries() const { return pairs_.entries() * lanes; }

  void set_courant(double courant) {
    const double k = std::pow(0.55 * courant, 2);
    const PairView view = pairs_.view();
    Vector s("perf.s", static_cast<size_t>(size()));
    const auto weight = [&](int i, int j, double& d2) {
      const double dx = x_.x(j) - x_.x(i), dy = x_.y(j) - x_.y(i);
      d2 = dx * dx + dy * dy;
      return d2 > 0 ? std::pow(2 - std::sqrt(d2) / 1.5, 2) / std::sqrt(d2) : 0.0;
    };
    for (const bool moments : {true, false})
      for (int i = 0; i < size(); ++i) {
        double sum = 0, d2 = 0;
        for (int e = view.start(i / lanes); e < view.start(i / lanes + 1); ++e) {
          const int j = view.j(PairView::at(e, i % lanes));
          const double w = weight(i, j, d2), a = moments ? 0.5 * w * d2 : k * w * (1 / s(i) + 1 / s(j));
          if (!moments) a_(PairView::at(e, i % lanes)) = a;
          sum += a;
        }
        if (moments) s(i) = sum;
        else diagonal_(i) = 1 + sum, inverse_(i) = 1 / diagonal_(i);
      }
    set_mesh(k);
  }

  double multiply(const Vector& x, const Vector& y) {
    return sums_.sum<1, 64>("perf::product", pairs_.view().slices(),
                            linear::PairProduct<AllSlices>{pairs_.view(), {}, a_, diagonal_, mass_, x, y})[0];
  }
  void multiply() { multiply(right_, result_); }

  CgReport solve(bool meshed, double tolerance, int most) {
    const auto a = [this](const Vector& x, const Vector& y) { return multiply(x, y); };
    const linear::CgOptions options{tolerance, most};
    if (!meshed) return cg_.solve(a, linear::Jacobi{inverse_}, right_, found_, options);
    return cg_.solve(a, linear::JacobiPlus<linear::ParticleMesh<2>>{inverse_, mesh_}, right_, found_, options);
  }
  void correct() { (void)mesh_(right_, result_); }
  void set_mesh(double k) { mesh_.set(mass_, depth_, k); }

 private:
  void place() {
    const auto x = fields_.real("x", "m", Carry::sort), y = fields_.real("y", "m", Carry::sort), h = fields_.real("h", "m", Carry::sort);
    const auto id = fields_.integer("id", "1", Carry::sort);
    unsigned long long state = 12345;
    const auto off = [&] {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      return 0.2 * (static_cast<double>(state >> 11) * 0x1p-52 - 1);
    };
    for (int i = 0; i < size(); ++i) x(i) = i % side_ + off(), y(i) = i / side_ + off(), h(i) = 1.5, id(i) = i;
  }

  int side_;
  FieldSet fields_;
  RowOrder order_;
  VecField<double, 2> x_;
  Pairs pairs_;
  Vector a_, diagonal_, inverse_, mass_, depth_, right_, found_, result_;
  linear::ParticleMesh<2> mesh_;
  linear::ConjugateGradients cg_;
  OrderedSums sums_;
};

void print(const char* what, double seconds, double n, double bytes, double triad) {
  std::printf("%-28s %8.3f ms %8.2f ns/particle", what, 1e3 * seconds, 1e9 * seconds / n);
  if (bytes > 0) std::printf(" %8.2f GB/s %6.1f %% of triad", 1e-9 * bytes / seconds, 100 * bytes / seconds / triad);
  std::printf("\n");
}

void measure(int wanted) {
  System s(wanted);
  const double n = s.size(), triad = measure_peaks().bytes;
  s.set_courant(20);
  std::printf("%d particles, %.1f entries per row, %d threads; triad %.2f GB/s\n", s.size(), s.entries() / n, thread_count(), 1e-9 * triad);
  const double product_bytes = 12.0 * s.entries() + 40 * n;
  const double product = fastest(20, [&] { s.multiply(); });
  print("product", product, n, product_bytes, triad);
  constexpr int iterations = 10;
  const double plain = fastest(3, [&] { (void)s.solve(false, 1e-300, iterations); }) / iterations;
  print("CG iteration, Jacobi", plain, n, product_bytes + (24 + 72) * n, triad);  // p, z; x, r, z written, p, q, D read
  print("CG iteration, particle mesh", fastest(3, [&] { (void)s.solve(true, 1e-300, iterations); }) / iterations, n, 0, triad);
  print("particle-mesh correction", fastest(5, [&] { s.correct(); }), n, 0, triad);
  print("particle-mesh set-up", fastest(5, [&] { s.set_mesh(1.0); }), n, 0, triad);
  for (const double courant : {5.0, 20.0, 100.0}) {
    s.set_courant(courant);
    CgReport jacobi, meshed;
    const double seconds = fastest(1, [&] { jacobi = s.solve(false, 1e-8, 3000); });
    const double alone = fastest(1, [&] { meshed = s.solve(true, 1e-8, 3000); });
    std::printf("Courant %3.0f: Jacobi %3d iterations %.3f s, with the mesh %2d iterations %.3f s\n", courant, jacobi.iterations, seconds,
                meshed.iterations, alone);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime kokkos(std::getenv("OMP_NUM_THREADS") ? std::atoi(std::getenv("OMP_NUM_THREADS")) : 0);
  measure(argc > 1 ? std::atoi(argv[1]) : 125316);
}
