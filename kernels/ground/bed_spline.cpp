#include "kernels/ground/bed_spline.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cellgrid/parallel/on_device.hpp"

namespace freshet {
namespace {

// A line of the lattice: n values `stride` apart.
struct Line {
  double* v;
  int n, stride;
  double& operator[](int k) const { return v[static_cast<size_t>(std::clamp(k, 0, n - 1)) * stride]; }
};

// Smoothing by (a, 1 - 2a, a) passes with the given variance in units of the spacing squared; at most 1/3 per
// pass, the variance of the B-spline itself. The rim is continued linearly.
void smooth(const Line& line, double variance) {
  const int passes = static_cast<int>(std::ceil(3 * variance));
  if (passes == 0) return;
  const double a = 0.5 * variance / passes;
  std::vector<double> old(line.n);
  for (int pass = 0; pass < passes; ++pass) {
    for (int k = 0; k < line.n; ++k) old[k] = line[k];
    for (int k = 1; k + 1 < line.n; ++k) line[k] = old[k] + a * (old[k - 1] - 2 * old[k] + old[k + 1]);
  }
}

// Coefficients of the interpolating cubic B-spline with zero second difference of the coefficients at both
// ends: solves (1 4 1)/6 c = v; the end conditions make c_0 = v_0.
void interpolate(const Line& line) {
  const int n = line.n;
  std::vector<double> upper(n, 0.0);
  for (int k = 1; k + 1 < n; ++k) {  // Thomas' algorithm, rows c_{k-1} + 4 c_k + c_{k+1} = 6 v_k
    const double pivot = 4 - upper[k - 1];
    upper[k] = 1 / pivot;
    line[k] = (6 * line[k] - line[k - 1]) / pivot;
  }
  for (int k = n - 2; k > 0; --k) line[k] -= upper[k] * line[k + 1];
}

// Largest difference of neighbouring coefficients along each axis, combined: the slope of a B-spline is a
// mean of them.
double steepest_step(const std::vector<double>& c, int nx, int ny) {
  double along_x = 0, along_y = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const size_t k = static_cast<size_t>(j) * nx + i;
      if (i + 1 < nx) along_x = std::max(along_x, std::abs(c[k + 1] - c[k]));
      if (j + 1 < ny) along_y = std::max(along_y, std::abs(c[k + nx] - c[k]));
    }
  return std::hypot(along_x, along_y);
}

}  // namespace

template <int D>
BedSpline<D>::BedSpline(const std::function<double(double, double)>& level, const Lattice& lattice)
    : inv_spacing_(1 / lattice.spacing) {
  // nodes: wide enough for buffers outside the domain and for the ends to be forgotten
  constexpr int margin = 12;
  const auto nodes = [&](int k) {
    return static_cast<int>(std::ceil((lattice.high[k] - lattice.low[k]) / lattice.spacing - 1e-9)) + 1 +
           2 * margin;
  };
  nx_ = nodes(0);
  ny_ = D == 2 ? nodes(1) : 1;
  x0_ = lattice.low[0] - margin * lattice.spacing;
  y0_ = D == 2 ? lattice.low[1] - margin * lattice.spacing : 0;
  std::vector<double> values(static_cast<size_t>(nx_) * ny_);
  for (int j = 0; j < ny_; ++j)
    for (int i = 0; i < nx_; ++i)
      values[static_cast<size_t>(j) * nx_ + i] = level(x0_ + i * lattice.spacing, y0_ + j * lattice.spacing);
  const double variance = lattice.filter * lattice.filter * inv_spacing_ * inv_spacing_;
  const auto both = [&](const Line& line) {
    smooth(line, variance);
    interpolate(line);
  };
  for (int j = 0; j < ny_; ++j) both({&values[static_cast<size_t>(j) * nx_], nx_, 1});
  for (int i = 0; D == 2 && i < nx_; ++i) both({&values[static_cast<size_t>(i)], ny_, nx_});
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  range_ = {*lowest, *highest};
  steepest_ = steepest_step(values, nx_, ny_) * inv_spacing_;
  level_ = on_device("bed.level", values);
}

template class BedSpline<1>;
template class BedSpline<2>;

}  // namespace freshet
