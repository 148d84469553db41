// [scene], [domain], [time], [output], [limits]: plain numbers and choices.
#include <cmath>

#include "src/reference/exact.hpp"
#include "src/scene/sections/sections.hpp"

namespace freshet::input {

void read_scene_section(Table& section, Scene& scene) {
  scene.name = section.text("name").otherwise(scene.name);
  scene.method =
      section.choice<std::string>("method", {{"sph-swe", "sph-swe"}, {"sisph", "sisph"}, {"fpm", "fpm"}})
          .otherwise(scene.method);
  scene.gravity = section.number("gravity", "m/s2").positive().otherwise(scene.gravity);
  section.context().gravity = scene.gravity;
}

void read_domain(Table& section, Scene& scene) {
  Value<std::vector<double>> box = section.numbers("box", "numbers in m: x0, y0, x1, y1, or x0, x1 in 1-D");
  const std::vector<double> b = box.required({0, 0, 1, 1});
  Domain& domain = scene.domain;
  if (b.size() == 4) {
    domain = {2, {b[0], b[1]}, {b[2], b[3]}};
  } else if (b.size() == 2) {
    domain = {1, {b[0], 0}, {b[1], 0}};
  } else {
    box.fail("'domain.box' has " + std::to_string(b.size()) +
             " numbers; 2-D: [x0, y0, x1, y1], 1-D: [x0, x1]");
    return;
  }
  const bool ordered =
      domain.low[0] < domain.high[0] && (domain.dimension == 1 || domain.low[1] < domain.high[1]);
  if (!ordered) box.fail("'domain.box' must have its low corner first");
  if (!ordered) domain = {2, {0, 0}, {1, 1}};
}

std::optional<double> read_duration(Table& section, const std::string& key, const Scene& scene) {
  if (!section.has_table(key)) return section.number(key, "s").at_least(0).optional();
  Table duration = section.table(key);
  Value<double> periods = duration.number("periods");
  const double count = periods.positive().required(1);
  const double period = scene.compare.exact ? scene.compare.exact->period() : 0;
  if (period > 0) return count * period;
  if (section.context().exact_failed) return 0;
  periods.fail("'" + duration.path_of("periods") + "' needs a periodic exact solution",
               "name one under [compare], or give the duration in seconds");
  return 0;
}

void read_time(Table& section, const ComparePlan& compare, Scene& scene) {
  const auto end = read_duration(section, "end", scene);
  if (!section.has("end")) section.number("end", "s").required();
  if (end && *end == 0 && section.has_number("end"))
    section.error("end", "'time.end' is 0; it must be positive");
  scene.end_time = end.value_or(0) + (compare.around_end ? 0.5 * compare.window : 0.0);
  if (end && compare.window > scene.end_time) {
    section.error("end",
                  "the run ends before the comparison window of " + shown(compare.window) + " s is over");
  }
  if (end && !scene.compare.times.empty() && scene.compare.times.back() > scene.end_time) {
    section.error("end", "the run ends before " + shown(scene.compare.times.back()) +
                             " s, the last of 'compare.times'");
  }
  scene.cfl = section.number("cfl")
                  .positive()
                  .check([](double cfl) { return cfl <= 2; }, "at most 2")
                  .otherwise(scene.cfl);
  Value<double> step = section.number("dt", "s").positive();
  if (step.given() && scene.method != "sisph")
    section.context().notes.push_back("time.dt counts for the method \"sisph\" alone; the step of \"" +
                                      scene.method + "\" follows from time.cfl");
  scene.time_step = step.otherwise(scene.time_step);
}

// What the points of the method have (src/io/h5part.cpp).
std::vector<std::string> particle_fields(const Scene& scene) {
  if (scene.method == "fpm") return {"u", "v", "p", "surface", "h", "size"};
  if (scene.domain.dimension == 1) return {"z", "depth", "u", "mass", "h", "bed", "size"};
  return {"z", "depth", "u", "v", "mass", "h", "bed", "size"};
}

void read_output(Table& section, Scene& scene) {
  Output& output = scene.output;
  output.every = read_duration(section, "every", scene).value_or(output.every);
  output.gauges_every = read_duration(section, "gauges_every", scene).value_or(output.gauges_every);
  output.checkpoint_every =
      section.number("checkpoint_every", "s").at_least(0).otherwise(output.checkpoint_every);
  output.fields = section.words("fields", particle_fields(scene)).optional();
}

void read_limits(Table& section, Scene& scene) {
  scene.limits.mass_error = section.number("mass_error").positive().otherwise(scene.limits.mass_error);
  scene.limits.speed = section.number("speed", "m/s").positive().otherwise(scene.limits.speed);
}

}  // namespace freshet::input
