// perf_cg [particles]: the free-surface solver's parts from memory: triad, matrix product over stored pairs
// (SELL-W) and with coefficients found anew, a whole CG iteration with Jacobi and with the particle-mesh
// preconditioner; GB/s modelled, and as a share of the triad measured in the same run. Then iterations and
// seconds of a solve to 1e-8 by celerity Courant number. Particles: a lattice moved by up to 0.2 dx.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "cellgrid/parallel/runtime.hpp"
#include "kernels/linear/cg.hpp"
#include "kernels/linear/mesh/particle_mesh.hpp"
#include "kernels/sisph/pairs/coefficients.hpp"
#include "src/run/timing/fastest.hpp"
#include "src/run/timing/peaks.hpp"

namespace {

using namespace freshet;
using linear::CgReport;
using linear::Vector;

constexpr double smoothing = 1.5;  // l / dx

struct AllSlices {
  KOKKOS_FORCEINLINE_FUNCTION int operator()(int k) const { return k; }
};

// omega x_i + sum_j a_ij (x_i - x_j), a_ij = k A_ij / d_ij: the free surface's matrix
// (kernels/sisph/pairs/coefficients.hpp).
class System {
 public:
  explicit System(int wanted)
      : side_(static_cast<int>(std::lround(std::sqrt(wanted)))), fields_(side_ * side_),
        order_(2, 1.0, {-1.0, side_ + 1.0, -1.0, side_ + 1.0}) {
    place();
    order_.sort(fields_);
    x_ = {fields_.real("x"), fields_.real("y")};
    order_.measure_reach(fields_, fields_.real("h"), 2.0);
    g_ = sisph::measure_geometry<2>(
        size(), kernel_, {order_.rows(), x_, fields_.real("h"), fields_.integer("held"), 1.0, 1.0});
    const auto vector = [this] { return Vector("perf.vector", static_cast<size_t>(size()) + lanes); };
    for (Vector* v : {&diagonal_, &inverse_, &depth_, &right_, &found_, &result_}) *v = vector();
    a_ = Vector("perf.a", g_.pairs.j.extent(0));
    linear::fill(size(), 1.0, depth_);
    places_ = {1 / smoothing, g_.x, {vector(), vector()}, g_.omega, vector()};
    for (int i = 0; i < size(); ++i) places_.per_moment(i) = 1 / g_.moment(i);
    for (int i = 0; i < size(); ++i) {
      const double s = side_, along = x_.x(i) / s - 0.4, across = x_.y(i) / s - 0.5;
      right_(i) = std::exp(-30 * along * along - 20 * across * across) + 0.05 * std::sin(12.9898 * i);
    }
    mesh_.lay(order_.rows(), x_, size());
    cg_.resize(size());
  }

  int size() const { return fields_.size(); }
  int entries() const { return g_.pairs.start(g_.pairs.slices()) * lanes; }

  // Water 1 m deep.
  void set_courant(double courant) {
    stiffness_ = std::pow(0.55 * courant, 2);
    for (int s = 0; s < g_.pairs.slices(); ++s)
      for (int l = 0; l < g_.pairs(s).count; ++l) {
        const int i = g_.pairs(s).particle(l);
        double sum = g_.omega(i);
        for (int e = g_.pairs.start(s); e < g_.pairs.start(s + 1); ++e) {
          const size_t k = PairView::at(e, l);
          sum += a_(k) = stiffness_ * g_.area(k) / g_.distance(k);
        }
        diagonal_(i) = sum, inverse_(i) = 1 / sum;
      }
    set_mesh(stiffness_);
  }

  // sum_j a_ij x_j with coefficients from places and depths; the closure's multipliers are zero, which takes
  // as long as others.
  void multiply_anew() {
    using Found = sisph::RecomputedPairs<2, CubicSpline<2>, false>;
    const Found found{
        std::get<CubicSpline<2>>(kernel_), places_, {depth_, depth_, depth_, {}, false}, stiffness_};
    (void)sum_of_slices<1>(
        "perf::product_anew", g_.pairs.slices(),
        linear::PairProduct<AllSlices, Found>{g_.pairs, {}, found, diagonal_, g_.free, right_, result_});
  }

  double multiply(const Vector& x, const Vector& y) {
    return sum_of_slices<1>("perf::product", g_.pairs.slices(),
                            linear::PairProduct<AllSlices>{g_.pairs, {}, {a_}, diagonal_, g_.free, x, y})[0];
  }
  void multiply() { multiply(right_, result_); }

  CgReport solve(bool meshed, double tolerance, int most) {
    const auto a = [this](const Vector& x, const Vector& y) { return multiply(x, y); };
    const linear::CgOptions options{tolerance, most};
    if (!meshed) return cg_.solve(a, linear::Jacobi{inverse_}, right_, found_, options);
    return cg_.solve(a, linear::JacobiPlus<linear::ParticleMesh<2>>{inverse_, mesh_}, right_, found_,
                     options);
  }
  void correct() { (void)mesh_(right_, result_); }
  void set_mesh(double k) { mesh_.set(g_.omega, depth_, k); }

 private:
  void place() {
    const auto x = fields_.real("x", "m", Carry::sort), y = fields_.real("y", "m", Carry::sort),
               h = fields_.real("h", "m", Carry::sort);
    const auto id = fields_.integer("id", "1", Carry::sort), held = fields_.integer("held", "1", Carry::sort);
    unsigned long long state = 12345;
    const auto off = [&] {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      return 0.2 * (static_cast<double>(state >> 11) * 0x1p-52 - 1);
    };
    for (int i = 0; i < size(); ++i)
      x(i) = i % side_ + off(), y(i) = i / side_ + off(), h(i) = smoothing, id(i) = i, held(i) = 0;
  }

  int side_;
  FieldSet fields_;
  RowOrder order_;
  VecField<double, 2> x_;
  AnyKernel<2> kernel_ = make_kernel<2>(kernel::Cubic{}, smoothing, false);
  sisph::Geometry<2> g_;
  sisph::Places<2> places_;
  double stiffness_ = 0;
  Vector a_, diagonal_, inverse_, depth_, right_, found_, result_;
  linear::ParticleMesh<2> mesh_;
  linear::ConjugateGradients cg_;
};

void print(const char* what, double seconds, double n, double bytes, double triad) {
  std::printf("%-28s %8.3f ms %8.2f ns/particle", what, 1e3 * seconds, 1e9 * seconds / n);
  if (bytes > 0)
    std::printf(" %8.2f GB/s %6.1f %% of triad", 1e-9 * bytes / seconds, 100 * bytes / seconds / triad);
  std::printf("\n");
}

void measure(int wanted) {
  System s(wanted);
  const double n = s.size(), triad = measure_peaks().bytes;
  s.set_courant(20);
  std::printf("%d particles, %.1f entries per row, %d threads; triad %.2f GB/s\n", s.size(), s.entries() / n,
              thread_count(), 1e-9 * triad);
  const double product_bytes = 12.0 * s.entries() + 40 * n;
  const double product = fastest(20, [&] { s.multiply(); });
  print("product", product, n, product_bytes, triad);
  const double anew_bytes =
      4.0 * s.entries() +
      (40 + 56) * n;  // of the neighbours' seven values, which stay in the cache, once each
  print("product, coefficients anew", fastest(5, [&] { s.multiply_anew(); }), n, anew_bytes, triad);
  constexpr int iterations = 10;
  const double plain = fastest(3, [&] { (void)s.solve(false, 1e-300, iterations); }) / iterations;
  print("CG iteration, Jacobi", plain, n, product_bytes + (24 + 72) * n,
        triad);  // p, z; x, r, z written, p, q, D read
  print("CG iteration, particle mesh",
        fastest(3, [&] { (void)s.solve(true, 1e-300, iterations); }) / iterations, n, 0, triad);
  print("particle-mesh correction", fastest(5, [&] { s.correct(); }), n, 0, triad);
  print("particle-mesh set-up", fastest(5, [&] { s.set_mesh(1.0); }), n, 0, triad);
  for (const double courant : {5.0, 20.0, 100.0}) {
    s.set_courant(courant);
    CgReport jacobi, meshed;
    const double seconds = fastest(1, [&] { jacobi = s.solve(false, 1e-8, 3000); });
    const double alone = fastest(1, [&] { meshed = s.solve(true, 1e-8, 3000); });
    std::printf("Courant %3.0f: Jacobi %3d iterations %.3f s, with the mesh %2d iterations %.3f s\n", courant,
                jacobi.iterations, seconds, meshed.iterations, alone);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime kokkos(std::getenv("OMP_NUM_THREADS") ? std::atoi(std::getenv("OMP_NUM_THREADS")) : 0);
  measure(argc > 1 ? std::atoi(argv[1]) : 125316);
}
