#include "tests/support/points/pair_system.hpp"

namespace freshet::test {

PairSystem pair_system(const PairScene& scene) {
  const int n = scene.n;
  const double dx = 1.0 / n, h = 1.5 * dx, theta = 0.55, k = std::pow(theta * scene.courant * dx, 2);
  std::vector<Point> points = lattice(2, {0, n, 0, n}, dx);
  Random random(7);
  for (Point& p : points)
    p = {p[0] + random(-scene.disorder, scene.disorder) * dx,
         p[1] + random(-scene.disorder, scene.disorder) * dx};
  PairSystem s{point_fields(2, points), RowOrder(2, dx, wide(dx)), {}, {}, {}, {}, {}, {}};
  s.order.sort(s.fields);
  const auto size = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  const Field<double> x = s.fields.real("x"), y = s.fields.real("y");
  s.x = {x, y};
  s.omega.resize(size), s.depth.resize(size);
  const auto weight = [h](double r) {  // cubic spline
    const double q = r / h, c = 10 / (7 * M_PI * h * h);
    return c * (q < 1 ? 1 - 1.5 * q * q + 0.75 * q * q * q : q < 2 ? 0.25 * std::pow(2 - q, 3) : 0);
  };
  const auto slope = [h](double r) {  // -W'
    const double q = r / h, c = 10 / (7 * M_PI * h * h * h);
    return c * (q < 1 ? 3 * q - 2.25 * q * q : q < 2 ? 0.75 * std::pow(2 - q, 2) : 0);
  };
  std::vector<std::vector<std::pair<int, double>>> near(size);  // j, distance
  const Rows& rows = s.order.rows();
  for (std::size_t i = 0; i < size; ++i) {
    const int me = static_cast<int>(i);
    double sum = weight(0);
    rows.for_each_run(x(me), x(me), y(me), y(me), 2 * h, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const double r = std::hypot(x(j) - x(me), y(j) - y(me));
        if (j == me || r >= 2 * h) continue;
        near[i].emplace_back(j, r);
        sum += weight(r);
      }
    });
    s.omega[i] = 1 / sum;
    s.depth[i] = std::max(0.0, scene.depth(x(me), y(me)));
  }
  std::vector<double> moment(size);
  for (std::size_t i = 0; i < size; ++i)
    for (const auto& [j, r] : near[i]) moment[i] += 0.5 * s.omega[static_cast<std::size_t>(j)] * slope(r) * r;
  std::vector<Eigen::Triplet<double>> entries;
  s.mass = Field<double>("mass", size), s.depth_field = Field<double>("depth", size);
  for (std::size_t i = 0; i < size; ++i) {
    const int me = static_cast<int>(i);
    const bool wet = s.depth[i] > 0;
    s.mass(me) = wet ? s.omega[i] : 0.0, s.depth_field(me) = s.depth[i];
    double diagonal = s.mass(me);
    for (const auto& [neighbour, r] : near[i]) {
      const auto j = static_cast<std::size_t>(neighbour);
      const double face = wet && s.depth[j] > 0 ? 0.5 * (s.depth[i] + s.depth[j]) : 0;  // a shore as a wall
      const double a = k * s.omega[i] * s.omega[j] * slope(r) * (1 / moment[i] + 1 / moment[j]) * face / r;
      diagonal += a;
      if (a > 0) entries.emplace_back(me, neighbour, -a);
    }
    entries.emplace_back(me, me, diagonal > 0 ? diagonal : 1.0);
  }
  s.matrix.resize(static_cast<int>(size), static_cast<int>(size));
  s.matrix.setFromTriplets(entries.begin(), entries.end());
  return s;
}

}  // namespace freshet::test
