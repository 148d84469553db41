// Clouds of particles for tests of cellgrid and the kernels, made without a scene: points and random numbers,
// sorted field sets, and a Cloud that is sorted, listed, walled and solved as a step does it. Results are
// read back by particle id.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "kernels/swe/density/density.hpp"
#include "kernels/swe/density/depth_gradient.hpp"
#include "kernels/swe/force/internal_force.hpp"
#include "kernels/swe/single_precision.hpp"

namespace freshet::test {

// The same uniform numbers with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

template <class T>
std::vector<T> shuffled(std::vector<T> values, unsigned seed) {
  Random random(seed);
  for (std::size_t k = values.size(); k > 1; --k)
    std::swap(values[k - 1], values[static_cast<std::size_t>(random(0, static_cast<double>(k)))]);
  return values;
}

inline std::vector<int> numbers(int n) {
  std::vector<int> ids(static_cast<std::size_t>(n));
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

// n points in the square (1-D: the interval) from -half to half around a centre.
inline std::vector<Point> random_points(int dimension, int n, double half, unsigned seed,
                                        Point centre = {0, 0}) {
  Random random(seed);
  std::vector<Point> points(static_cast<std::size_t>(n));
  for (Point& p : points) {
    p[0] = centre[0] + random(-half, half);
    p[1] = dimension == 2 ? centre[1] + random(-half, half) : 0;
  }
  return points;
}

// Centres (i + 1/2, j + 1/2) dx for i0 <= i < i1, j0 <= j < j1; 1-D: one row on y = 0.
struct Block {
  int i0, i1, j0, j1;
};
inline std::vector<Point> lattice(int dimension, const Block& b, double dx) {
  std::vector<Point> points;
  for (int j = b.j0; j < (dimension == 2 ? b.j1 : b.j0 + 1); ++j)
    for (int i = b.i0; i < b.i1; ++i)
      points.push_back({(i + 0.5) * dx, dimension == 2 ? (j + 0.5) * dx : 0.0});
  return points;
}

// A domain for points around the origin: 2000 spacings in each direction.
inline Box wide(double spacing) { return {-2000 * spacing, 2000 * spacing, -2000 * spacing, 2000 * spacing}; }

// x, (y), h and id of points, unsorted. ids: empty = in order.
FieldSet point_fields(int dimension, const std::vector<Point>& points, std::vector<int> ids = {});

// A particle as a test describes it; rho is the first guess of the depth, kh = rho0 h0^D the constant of rho
// h^D.
struct Grain {
  Point x, v{0, 0};
  double m, rho0, h0;
  double rho = rho0;
};

// n grains of about rho0 dx^D at random places, with masses within a factor of three and random velocities.
inline std::vector<Grain> random_water(int dimension, int n, double dx, unsigned seed) {
  const double half = 0.5 * dx * (dimension == 2 ? std::sqrt(n) : n);
  Random random(seed + 1000);
  std::vector<Grain> grains;
  for (const Point& p : random_points(dimension, n, half, seed)) {
    const double rho0 = 0.7 * random(0.5, 1.5), area = dimension == 2 ? dx * dx : dx;
    grains.push_back({p, {random(-1, 1), dimension == 2 ? random(-1, 1) : 0}, rho0 * area, rho0, 1.2 * dx});
  }
  return grains;
}

// A lattice of depth rho0, h = eta dx.
inline std::vector<Grain> still_water(int dimension, const std::vector<Point>& points, double dx, double rho0,
                                      double eta) {
  std::vector<Grain> grains;
  for (const Point& p : points)
    grains.push_back({p, {0, 0}, rho0 * (dimension == 2 ? dx * dx : dx), rho0, eta * dx});
  return grains;
}

// What is compared is the equations, not where the iteration stops, nor a list that is too short: a margin of
// 4 covers the way from the floor of h to its cap.
inline swe::DensityOptions tight(int dimension) {
  swe::DensityOptions options{};
  options.gravity = 9.81;
  options.tolerance = 1e-22;  // of the density; alpha is as good as its root
  options.margin = 4;
  options.bounds = {std::pow(1.6, -1.0 / dimension), 3};
  options.gradient = true;
  options.imposed_alpha = 1;
  return options;
}

// h held at eta dx: the depth is then the plain sum of m W and of the walls' terms.
inline swe::DensityOptions fixed_h() {
  auto options = tight(2);
  options.margin = 0.05;
  options.bounds = {1, 1};
  return options;
}

template <int D>
class Cloud {
 public:
  FieldSet fields;
  RowOrder order;
  ClusterSet clusters;
  NeighbourList neighbours;
  std::optional<Walls<D>> walls;
  swe::SingleCopies single;
  int lists = 0;      // made by the last solve()
  int cut_later = 0;  // lanes
  AnyKernel<D> kernel = CubicSpline<D>{};
  double support() const {
    return std::visit([](const auto& k) { return k.support; }, kernel);
  }

  Cloud(const std::vector<Grain>& grains, double spacing)
      : fields(static_cast<int>(grains.size())), order(D, spacing, wide(spacing)), spacing_(spacing) {
    const swe::Particles<D> p = declare(FieldList::making(fields));
    for (std::size_t k = 0; k < grains.size(); ++k) set(p, static_cast<int>(k), grains[k]);
  }

  void add_walls(const std::vector<Polyline>& lines, const Point& inside, WallKind kind = WallKind::mvbp) {
    walls.emplace(lines, WallOptions{kind, spacing_, 1.5 * support() * 1.2 * spacing_, true}, inside,
                  support());
  }

  swe::Particles<D> bind() const { return declare(FieldList::binding(fields)); }

  WallView<D> wall_view() const { return walls ? walls->view() : WallView<D>{}; }

  // Sorted, listed by the depths at hand, density solved; lists are made again as long as an h outgrows them.
  swe::DensityReport solve(const swe::DensityOptions& options) {
    order.sort(fields);
    clusters.cut(order.rows(), cut_later);
    const swe::Particles<D> p = bind();
    for (int i = 0; i < fields.size(); ++i)
      p.h(i) = clamp(swe::smoothing_length<D>(p.kh(i), p.rho(i)), options.bounds.floor * p.h0(i),
                     options.bounds.cap * p.h0(i));
    if (single.on()) swe::copy_motion<D>(p, fields.size());
    for (lists = 1;; ++lists) {
      list(options.margin);
      const auto report =
          swe::solve_density<D>(kernel, clusters, neighbours.view(), wall_view(), p, {}, options);
      if (report.outgrown == 0 || lists == 40) return report;
    }
  }

  // Twice: the rate and the strain belong to the h that the iteration starts from.
  void settle(const swe::DensityOptions& options) {
    solve(options);
    solve(options);
  }

  void force(const swe::AnyStabilisation& stabilise) {
    swe::find_depth_gradient<D>(kernel, clusters, neighbours.view(), bind());
    if (single.on()) swe::copy_state<D>(bind(), fields.size());
    swe::internal_force<D>(kernel, clusters, neighbours.view(), wall_view(), bind(), stabilise);
  }

  // Pairs in single precision from here on.
  void use_single() {
    single.motion = Kokkos::View<SingleRecord<4>*, Memory>(Kokkos::view_alloc("motion"),
                                                           static_cast<std::size_t>(fields.size()));
    single.state = Kokkos::View<SingleRecord<16>*, Memory>(Kokkos::view_alloc("state"),
                                                           static_cast<std::size_t>(fields.size()));
  }

  // The field's values in the order of the ids.
  std::vector<double> by_id(const char* name) const {
    std::vector<double> values(static_cast<std::size_t>(fields.size()));
    const auto field = fields.real(name);
    const auto id = fields.integer("id");
    for (int i = 0; i < fields.size(); ++i) values[static_cast<std::size_t>(id(i))] = field(i);
    return values;
  }
  double of(int id, const char* name) const { return by_id(name)[static_cast<std::size_t>(id)]; }

 private:
  swe::Particles<D> declare(const FieldList& list) const {
    swe::Particles<D> p;
    p.declare(list);
    p.declare_strain(list, false);
    p.declare_depth_slope(list);
    p.single = single;
    return p;
  }

  static void set(const swe::Particles<D>& p, int i, const Grain& g) {
    put(p.x, i, to_vec<D>(g.x));
    put(p.v, i, to_vec<D>(g.v));
    put(p.v_pred, i, to_vec<D>(g.v));
    p.m(i) = g.m, p.h0(i) = g.h0, p.rho(i) = g.rho;
    p.kh(i) = g.rho0 * power<D>(g.h0);
    p.id(i) = i;
  }

  void list(double margin) {
    const swe::Particles<D> p = bind();
    order.measure_reach(fields, p.h, support() * (1 + margin));
    const ListRequest<D> water{p.x, p.h, order.rows(), p.x, p.h, support(), margin};
    neighbours.build<D>(clusters, water);
    if (walls) walls->find(clusters, water, neighbours.view());
  }

  double spacing_;
};
extern template class Cloud<1>;  // cloud.cpp
extern template class Cloud<2>;

// The cubic spline as thesis (1.5) prints it, piece by piece, against the branch-free form of the kernels.
inline double printed_norm(int dimension) { return dimension == 1 ? 1.0 : 15.0 / (7.0 * pi); }
inline double printed_w(int dimension, double q) {
  if (q >= 2) return 0;
  return printed_norm(dimension) * (q <= 1 ? 2.0 / 3 - q * q + 0.5 * q * q * q : std::pow(2 - q, 3) / 6);
}
inline double printed_dw(int dimension, double q) {
  if (q >= 2) return 0;
  return printed_norm(dimension) * (q <= 1 ? -2 * q + 1.5 * q * q : -0.5 * (2 - q) * (2 - q));
}

inline double largest_size(const std::vector<double>& values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

}  // namespace freshet::test
