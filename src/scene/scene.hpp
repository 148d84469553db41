// The scene: what is computed, as a plain value. Methods receive it; only src/scene knows files and options.
// Its functions of x, y may keep state: call each from one thread at a time.
// Lengths in m, times in s; 1-D scenes use x only. Optional = not named in the scene = not computed.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/boundaries/open/states.hpp"
#include "kernels/boundaries/walls/point.hpp"
#include "src/scene/options.hpp"
#include "src/scene/shapes/function.hpp"

namespace freshet {

class Exact;  // src/reference/exact.hpp

struct Domain {
  int dimension = 2;            // 1 or 2
  Point low{0, 0}, high{1, 1};  // m; y = 0 in 1-D
};

struct Bed {
  Function elevation;       // m, upwards; absent = flat at zero: no bed pass
  double spacing = 0;       // m, of the bottom particles (the bed lattice)
  double filter = 0;        // m, standard deviation of the smoothing of the bed (0 = interpolated as given)
  std::string description;  // "expression", "file bathymetry.asc (393 x 244 nodes)": for the read-back
  std::array<double, 2> range{};  // m, lowest and highest value met on the bed lattice or in the file
  int nodata = 0;                 // cells without a value in the file
};

// Manning's n [s/m^(1/3)]: one number, or a map of the ground.
struct Manning {
  double n = 0;              // where there is no map
  Function map;              // by place; a place takes the value of the nearest node of the lattice:
  Point node{}, step{1, 1};  // m, one of its nodes, and their spacings
  std::string description;   // of the map: for the read-back
  Manning(double number = 0) : n(number) {}
};

struct Water {
  double spacing = 0;  // m, particle spacing dx
  // relaxed: cells, then pushed by their own pressure until they lie still along slanting and curved walls
  enum class Start { cells, equal_mass, relaxed } start = Start::cells;
  Function depth;                    // m; particles are placed where it is > wet_above
  Function surface;                  // m; absent where the scene gives the depth: depth = surface - bed
  std::array<Function, 2> velocity;  // m/s; absent = at rest
  double wet_above = 0;              // m
  double disorder = 0;  // x dx: each particle starts up to so far off its cell's centre along each axis
  int seed = 1;         // of the disorder
};

struct Wall {
  // m; the water is on its left (1-D: one point; the water is on the domain's side). A closed line, whose
  // last point is its first, also says where water may start: inside it if it runs counter-clockwise, else
  // outside.
  std::vector<Point> line;
};

struct OpenBoundary {
  std::string name;
  // m, two points or more (no sharp bends); the water is on its left. 1-D: (x, 1), (x, 0) at the left end and
  // (x, 0), (x, 1) at the right end.
  std::vector<Point> line;
  OpenLaw law;  // kernels/boundaries/open/states.hpp: what follows time is in `imposed`
  struct Imposed {
    std::string what;  // "level"
    std::string unit;  // "m"; discharges m3/s (1-D: m2/s); velocities and discharges inwards
    Series series;
  };
  std::vector<Imposed> imposed;  // in the order in which the law's set() takes them
  double spacing = 0;            // m, of the boundary particles; 0 = as the water

  OpenLaw at(double time) const;
};

// What a gauge can show, in the order of Gauge::What: its name in scenes and files, its unit there, and those
// of tables of errors and of peaks.
struct Measurand {
  const char *name, *unit;
  struct Scale {
    const char* unit;
    double size;  // in units of the measurand
  } fine, coarse;
};

struct Gauge {
  std::string name;
  Point at{};
  // Method "fpm" only, but for elevation: pressure at the point; front: the water's largest x, wherever it
  // is.
  enum class What { elevation, pressure, front } what = What::elevation;
  std::optional<Series> measured;  // of the same measurand, times increasing
  double peak_after = 0;           // s, peaks and arrivals are taken after this time
  double arrival_level = 0.01;     // in its unit; its first crossing counts as arrival
  const Measurand& measurand() const { return measurands[static_cast<std::size_t>(what)]; }

  static constexpr std::array<Measurand, 3> measurands{{{"elevation", "m", {"mm", 1e-3}, {"cm", 1e-2}},
                                                        {"pressure", "Pa", {"Pa", 1}, {"Pa", 1}},
                                                        {"front", "m", {"mm", 1e-3}, {"cm", 1e-2}}}};
};

struct RunUp {
  std::string name;
  Point at{};
  double radius = 0.05;                           // m
  double min_depth = 0.002;                       // m
  std::optional<std::array<double, 2>> measured;  // m, lowest and highest
};

// The surface along a line at one time.
struct Transect {
  std::string name;
  std::array<Point, 2> line{};  // m, from and to
  bool one_dimensional = false;
  double time = 0;                 // s
  double spacing = 0;              // m, of the points that are written
  std::optional<Series> measured;  // free-surface elevation [m] over the place on the line [m]: 1-D x, 2-D
                                   // distance from line[0]
  Point at(double place) const;    // the point of the line there
};

struct Compare {
  std::shared_ptr<const Exact> exact;
  double threshold = 1e-3;             // m, depth_l1_rel counts where the exact depth is above it
  std::optional<double> grid_spacing;  // m, of the regular grid of grid_l2_rel (default: 1/200 of the domain)
  int samples = 1;                     // depth_l1_rel is the median over this many times ...
  double window = 0;                   // s, ... evenly spread over the last `window` seconds before the end
  std::vector<double> times;           // s, increasing: all errors are also taken at these
  Function where;                      // errors count where it is not 0; absent = everywhere
  bool steady = false;      // the exact flow does not change: largest speed and rate of change are recorded
  std::string description;  // "stoker: 10 m | 5 m, dam at 1000 m": for the read-back
};

struct Output {
  double every = 0;                                // s, particle output (0 = first and last state only)
  double gauges_every = 0;                         // s (0 = as `every`)
  double checkpoint_every = 600;                   // s of wall clock
  std::optional<std::vector<std::string>> fields;  // of particles.h5part; absent: as ParticleFile has them
};

// Maps on a grid of square cells that covers the domain.
struct Rasters {
  enum class Quantity { depth, surface, u, v, speed };
  double spacing = 0;  // m, of the cells
  double every = 0;    // s (0 = first and last state only)
  std::vector<Quantity> what;
  // largest depth, speed and their product, arrival and last wetness, looked at in every step
  bool maxima = false;
  double arrival = 0.01;  // m, a cell is reached where the depth exceeds it
};

struct Limits {
  double mass_error = 1e-6;  // relative
  double speed = 1e4;        // m/s
};

struct Scene {
  std::string name;
  std::string method = "sph-swe";
  std::string file;  // path as given, for messages
  std::string text;  // the scene as read, overrides applied, data files absolute: written into every result
  std::vector<std::string> notes;  // what the reader decided on its own, one line each
  double gravity = 9.81;           // m/s2
  std::optional<Manning> manning;
  double cfl = 0.4;
  double time_step = 0;  // s, fixed (sisph); 0 = follows from the flow
  double end_time = 0;   // s
  Domain domain;
  Bed bed;
  Water water;
  std::vector<Wall> walls;
  std::vector<OpenBoundary> boundaries;
  std::vector<Gauge> gauges;
  std::vector<RunUp> run_ups;
  std::vector<Transect> profiles;
  Sph sph;
  Sisph sisph;
  std::optional<Split> split;
  std::optional<Merge> merge;
  std::optional<Fpm> fpm;
  Compare compare;
  Output output;
  std::optional<Rasters> rasters;
  Limits limits;

  // Compiled once (scene.cpp): 10 kB of machine code, in each source that holds a scene.
  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();
};

}  // namespace freshet
