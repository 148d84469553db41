// The sections of a scene file, one function each; read.cpp calls them in the order of their needs.
#pragma once
#include <optional>
#include <string>

#include "src/scene/scene.hpp"
#include "src/scene/toml/table.hpp"

namespace freshet::input {

void read_scene_section(Table& section, Scene& scene);  // [scene] name, method, gravity
void read_domain(Table& section, Scene& scene);         // [domain] box

// [sph]. The default of `acceleration` depends on [compare]: false where the scene does not name it.
bool read_sph(Table& section, Scene& scene);

void read_sisph(Table& section, Scene& scene);               // [sisph]
void check_formulation(Table& section, const Scene& scene);  // of [sisph], once all else is read

// [bed]. Needs the domain, water.spacing and sph.eta.
void read_bed(Table& section, Scene& scene);

void read_split(Table& section, Scene& scene);  // [split], if it is named; needs the domain
void read_merge(Table& section, Scene& scene);  // [merge], likewise, after [split]
// bed.manning. Needs the domain, water.spacing and bed.spacing.
void read_manning(Table& bed, Scene& scene);

// [compare]. Needs the bed and water.spacing.
struct ComparePlan {
  double window = 0;        // s
  bool around_end = false;  // the window lies around time.end: the run goes on for half of it
};
ComparePlan read_compare(Table& section, Scene& scene);

// [water]: spacing, start and wet_above come first (bed and comparison need them), the state later.
void read_spacing(Table& section, Scene& scene);
void read_water_state(Table& section, Scene& scene);

void read_time(Table& section, const ComparePlan& compare, Scene& scene);  // [time] end, cfl
void read_boundary(Table& section, Scene& scene);                          // one [[boundary]]; needs time.end
void read_wall(Table& section, Scene& scene);      // one [[wall]]; needs the boundaries
void note_leaks(Table& root, const Scene& scene);  // open ends of walls; after all walls
void read_gauge(Table& section, Scene& scene);     // one [[gauge]]
void read_run_up(Table& section, Scene& scene);    // one [[runup]]
void read_transect(Table& section, Scene& scene);  // one [[profile]]; needs time.end and water.spacing
void read_output(Table& section, Scene& scene);    // [output]
void read_rasters(Table& section, Scene& scene);   // [raster]; needs output.every
void read_limits(Table& section, Scene& scene);    // [limits]

// Method "fpm". [fluid] comes first; read_periodic (domain.periodic) needs [water] and [fpm].
void read_fluid(Table& section, Scene& scene);
void read_fpm(Table& section, Scene& scene);
void read_periodic(Table& domain, Scene& scene);
void read_body(Table& section, Scene& scene);  // one [[body]]

// A duration: a positive number of seconds or { periods = n } of the exact solution.
std::optional<double> read_duration(Table& section, const std::string& key, const Scene& scene);

// Reports `point` as an error of `key` unless it lies in the domain (edges included).
bool require_inside(Table& section, const std::string& key, const std::string& what, const Point& point,
                    const Scene& scene);
std::string shown(const Point& point, const Domain& domain);  // "(4.521, 1.196)", 1-D "1000"

}  // namespace freshet::input
