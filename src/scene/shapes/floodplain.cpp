#include "src/scene/shapes/floodplain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace freshet::input {
namespace {

double between(double low, double high, double share) { return low + (high - low) * share; }
double smooth_step(double s) {  // 0 ... 1 with level ends
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

// A number of [0, 1) that depends on the seed and two whole numbers alone (splitmix64).
double hashed(int seed, long i, long j) {
  std::uint64_t z = static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15u +
                    static_cast<std::uint64_t>(i) * 0xbf58476d1ce4e5b9u +
                    static_cast<std::uint64_t>(j) * 0x94d049bb133111ebu + 0x632be59bd9b4e019u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// Random values of [-1, 1] at lattice points one `length` apart, smooth in between.
double unevenness(int seed, double length, double x, double y) {
  const double u = x / length, v = y / length;
  const long i = static_cast<long>(std::floor(u)), j = static_cast<long>(std::floor(v));
  const double a = smooth_step(u - static_cast<double>(i)), b = smooth_step(v - static_cast<double>(j));
  const auto at = [&](long di, long dj) { return 2 * hashed(seed, i + di, j + dj) - 1; };
  return between(between(at(0, 0), at(1, 0), a), between(at(0, 1), at(1, 1), a), b);
}

// Ground that rises from the plain to 8 m over the outer 400 m, with a gap 500 m wide where the breach is.
double rim(const Floodplain& p, double x, double y) {
  constexpr double height = 8, width = 400, gap = 250, flank = 150;  // m
  const auto wall = [&](double from_edge) { return 1 - smooth_step(from_edge / width); };
  const double middle = 0.5 * (p.low[0] + p.high[0]);
  const double beside_gap = smooth_step((std::abs(x - middle) - gap) / flank);
  const double sides = std::max({wall(x - p.low[0]), wall(p.high[0] - x), wall(y - p.low[1])});
  return height * std::max(sides, beside_gap * wall(p.high[1] - y));
}

// Eight low areas of 1 to 2 m, 250 to 600 m in radius, away from the rim.
double low_areas(const Floodplain& p, double x, double y) {
  double depth = 0;
  for (int k = 0; k < 8; ++k) {
    const auto random = [&](int n) { return hashed(p.seed + 1000, k, n); };
    const double cx = between(p.low[0], p.high[0], 0.1 + 0.8 * (k + random(0)) / 8),
                 cy = between(p.low[1], p.high[1], between(0.2, 0.8, random(1)));
    const double radius = between(250, 600, random(2)),
                 r2 = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (radius * radius);
    depth = std::max(depth, between(1, 2, random(3)) * std::exp(-r2));
  }
  return depth;
}

// 2.5 m above the plain, its crest 30 m wide with flanks of 40 m, from the lower left to the middle; an
// underpass 60 m wide.
double embankment(const Floodplain& p, double x, double y) {
  constexpr double height = 2.5, crest = 15, flank = 40, pass = 30;  // m, half widths
  const Point a{between(p.low[0], p.high[0], 0.08), between(p.low[1], p.high[1], 0.12)};
  const Point b{between(p.low[0], p.high[0], 0.52), between(p.low[1], p.high[1], 0.55)};
  const double tx = b[0] - a[0], ty = b[1] - a[1], length = std::hypot(tx, ty);
  const double along = std::clamp(((x - a[0]) * tx + (y - a[1]) * ty) / length, 0.0, length);
  const double away = std::hypot(x - a[0] - along * tx / length, y - a[1] - along * ty / length);
  const double closed = smooth_step((std::abs(along - 0.6 * length) - pass) / flank);
  return height * closed * (1 - smooth_step((away - crest) / flank));
}

}  // namespace

Function floodplain(const Floodplain& plain) {
  return [plain](double x, double y) {
    const double uneven = 0.4 * unevenness(plain.seed, 900, x, y) +
                          0.2 * unevenness(plain.seed + 1, 300, x, y) +
                          0.05 * unevenness(plain.seed + 2, 80, x, y);
    return 2 + uneven - low_areas(plain, x, y) + std::max(rim(plain, x, y), embankment(plain, x, y));
  };
}

}  // namespace freshet::input
