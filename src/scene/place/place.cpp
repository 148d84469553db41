#include "src/scene/place/place.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "src/errors.hpp"
#include "src/scene/place/random.hpp"
#include "src/scene/place/water_region.hpp"

namespace freshet {
namespace {

double finite_depth(const Function& depth, double x, double y) {
  const double d = depth(x, y);
  require_finite(d, {x, y});
  return d;
}

// Equal cells along one side of the box.
struct EvenCells {
  int n;
  double low, width;
  double centre(int k) const { return low + (k + 0.5) * width; }
};
EvenCells cells_along(const Scene& scene, int axis) {
  const double length = scene.domain.high[axis] - scene.domain.low[axis], width = cell_width(scene, axis);
  return {static_cast<int>(std::lround(length / width)), scene.domain.low[axis], width};
}

// The part of a cell that is in the water and its middle: all or nothing where corners and centre agree.
struct CutCell {
  double part;
  Point middle;
};
CutCell cut_cell(const WaterRegion& water, const Point& centre, double width, double height) {
  constexpr int fine = 10;  // sub-cells along a side
  int agree = water.holds(centre) ? 1 : 0;
  for (const double sx : {-0.5, 0.5})
    for (const double sy : {-0.5, 0.5})
      agree += water.holds({centre[0] + sx * width, centre[1] + sy * height}) ? 1 : 0;
  if (agree == 0 || agree == 5) return {agree / 5.0, centre};
  double count = 0, x = 0, y = 0;
  for (int k = 0; k < fine * fine; ++k) {
    const Point p{centre[0] + ((k % fine + 0.5) / fine - 0.5) * width,
                  centre[1] + ((k / fine + 0.5) / fine - 0.5) * height};
    if (!water.holds(p)) continue;
    ++count, x += p[0], y += p[1];
  }
  return {count / (fine * fine), count > 0 ? Point{x / count, y / count} : centre};
}

// As many particles as the machine's memory holds, and not more than whole numbers count.
double most_particles() {
  constexpr double bytes = 400;  // of a particle's fields and lists (tests/property/cost/memory.cpp)
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return std::min(1e9, memory / bytes);
}

[[noreturn]] void refuse_more_than(double most, double cells, const Scene& scene) {
  const double coarser = scene.water.spacing * std::pow(cells / most, 1.0 / scene.domain.dimension);
  char text[200];
  std::snprintf(
      text, sizeof text,
      "water: more than %.3g particles, which this machine's memory does not hold (400 bytes each)\n"
      "  help: a larger water.spacing than %.6g m; %.3g m if all of the domain is wet",
      most, scene.water.spacing, coarser);
  throw SceneError(text);
}

std::vector<Placed> place_cells(const Scene& scene, const Function& depth) {
  // of a cell: the water of smaller slivers along slanting walls is left out
  constexpr double least_part = 0.25;
  const WaterRegion water(scene.walls);
  std::vector<Placed> particles;
  const bool plane = scene.domain.dimension == 2;
  const EvenCells along_x = cells_along(scene, 0),
                  along_y = plane ? cells_along(scene, 1) : EvenCells{1, -0.5, 1};
  const double area = along_x.width * along_y.width, disorder = scene.water.disorder;
  const double cells = static_cast<double>(along_x.n) * along_y.n, most = most_particles();
  if (cells > 2e9) refuse_more_than(most, cells, scene);
  const auto moved = [&](const Point& middle, int cell) {
    const auto off = [&](int k) {
      return disorder * random_offset(scene.water.seed,
                                      2 * static_cast<std::uint64_t>(cell) + static_cast<std::uint64_t>(k));
    };
    const Point to{middle[0] + along_x.width * off(0), middle[1] + (plane ? along_y.width * off(1) : 0.0)};
    return disorder > 0 && water.holds(to) ? to : middle;
  };
  for (int j = 0; j < along_y.n; ++j)
    for (int i = 0; i < along_x.n; ++i) {
      CutCell cell{1, {along_x.centre(i), along_y.centre(j)}};
      if (plane && !water.everywhere()) cell = cut_cell(water, cell.middle, along_x.width, along_y.width);
      const Point at = moved(cell.middle, j * along_x.n + i);
      const double x = at[0], y = at[1], own = cell.part * area;
      if (cell.part < least_part) continue;
      const double d = finite_depth(depth, x, y), h0 = scene.sph.eta * (plane ? std::sqrt(own) : own);
      if (d > scene.water.wet_above) particles.push_back({{x, y}, d, own, h0, velocity_at(scene, x, y)});
      if (static_cast<double>(particles.size()) > most) refuse_more_than(most, cells, scene);
    }
  return particles;
}

// Equal masses m = d_max dx: each particle sits where half of its own mass lies behind it. The cumulative
// depth is summed on a fine raster whose cells divide the spacing, so that a dam between cells stays sharp.
std::vector<Placed> place_equal_mass(const Scene& scene, const Function& depth) {
  constexpr int fine = 64;
  EvenCells raster = cells_along(scene, 0);
  raster.n *= fine;
  raster.width /= fine;
  double deepest = 0;
  for (int k = 0; k < raster.n; ++k) deepest = std::max(deepest, finite_depth(depth, raster.centre(k), 0));
  const double mass = deepest * raster.width * fine;
  std::vector<Placed> particles;
  double before = 0;
  for (int k = 0; k < raster.n; ++k) {
    const double d = std::max(0.0, depth(raster.centre(k), 0)), here = d * raster.width;
    const double next = (particles.size() + 0.5) * mass;
    if (d > scene.water.wet_above && before + here >= next * (1 - 1e-12)) {
      const double x = raster.low + raster.width * (k + (next - before) / here), spacing = mass / d;
      particles.push_back({{x, 0}, d, spacing, scene.sph.eta * spacing, velocity_at(scene, x, 0)});
    }
    before += here;
  }
  return particles;
}

// A surface less a bed leaves rounding where it is dry: masses so far apart (1e-15) end in NaN sooner or
// later.
void drop_rounding(std::vector<Placed>& particles) {
  constexpr double rounding = 1e-9;  // of the deepest water
  double deepest = 0;
  for (const Placed& p : particles) deepest = std::max(deepest, p.depth);
  const auto dry = [&](const Placed& p) { return p.depth <= rounding * deepest; };
  particles.erase(std::remove_if(particles.begin(), particles.end(), dry), particles.end());
}

}  // namespace

Point velocity_at(const Scene& scene, double x, double y) {
  Point v{0, 0};
  for (int k = 0; k < 2; ++k)
    if (scene.water.velocity[k]) v[k] = scene.water.velocity[k](x, y);
  return v;
}

double cell_width(const Scene& scene, int axis) {
  const double length = scene.domain.high[axis] - scene.domain.low[axis];
  return length / std::max(1.0, std::round(length / scene.water.spacing));
}

void require_finite(double depth, const Point& x) {
  if (!std::isfinite(depth))
    throw SceneError("water: the depth at (" + std::to_string(x[0]) + ", " + std::to_string(x[1]) +
                     ") m is not a finite number; check the expressions of [water] and [bed] there");
}

std::vector<Placed> place(const Scene& scene, const Function& depth) {
  auto particles = scene.water.start == Water::Start::equal_mass ? place_equal_mass(scene, depth)
                                                                 : place_cells(scene, depth);
  drop_rounding(particles);
  if (particles.empty() && scene.boundaries.empty())
    throw SceneError("water: no particle is wet; the depth is nowhere above " +
                     std::to_string(scene.water.wet_above) + " m: check [water] and [bed]");
  return particles;
}

Box sorted_box(const Scene& scene) {
  // SISPH's sides that no wall holds go with the water.
  const bool spreads = scene.method == "sisph" && scene.sisph.moving && scene.walls.empty();
  const auto beyond = [&](std::size_t axis) {
    if (scene.fpm && scene.fpm->periodic[axis]) return 0.0;
    return 32 * scene.water.spacing +
           (spreads ? 8 * (scene.domain.high[axis] - scene.domain.low[axis]) : 0.0);
  };
  const Point &low = scene.domain.low, &high = scene.domain.high;
  return {low[0] - beyond(0), high[0] + beyond(0), low[1] - beyond(1), high[1] + beyond(1)};
}

}  // namespace freshet
