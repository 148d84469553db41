// Runs of incompressible scenes without files: the case's scene, the solver, and its points on the host.
#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "build_info.hpp"
#include "src/methods/fpm/solver.hpp"
#include "src/run/observe/events.hpp"
#include "src/scene/read.hpp"

namespace freshet::test {

struct FlowPoint {
  double x, y, u, v, p;
  int kind, surface;
};

class FlowRun {
 public:
  explicit FlowRun(const std::string& name, const std::vector<std::string>& overrides = {})
      : FlowRun(read_scene(std::string(build::source_dir) + "/cases/" + name + ".toml", overrides)) {}
  explicit FlowRun(const Scene& of)
      : scene(of), solver(scene), outputs_(regular_times(scene.output.every, scene.end_time)) {}

  // With steps that end on the scene's output times and at t.
  void run_to(double t) {
    while (clock.t < t) {
      outputs_.skip_past(clock.t);
      const Stride stride = stride_towards(std::min(outputs_.next(), t), clock, solver.stable_dt());
      solver.step(clock.t, stride.dt);
      clock = {stride.until, clock.step + 1};
      most_iterations = std::max(most_iterations, solver.pressure_report().solve.iterations);
    }
  }

  // Of equal length, whatever the solver would choose.
  void steps(int count, double dt) {
    for (int k = 0; k < count; ++k) solver.step(clock.t, dt), clock = {clock.t + dt, clock.step + 1};
  }

  std::vector<FlowPoint> points() const {
    const FieldSet& f = solver.fields();
    const auto x = on_host(f.real("x")), y = on_host(f.real("y")), u = on_host(f.real("u")),
               v = on_host(f.real("v")), p = on_host(f.real("p"));
    const auto kind = on_host(f.integer("kind")), surface = on_host(f.integer("surface"));
    std::vector<FlowPoint> all;
    for (int i = 0; i < f.size(); ++i) all.push_back({x(i), y(i), u(i), v(i), p(i), kind(i), surface(i)});
    return all;
  }

  Scene scene;
  fpm::FinitePointset solver;
  Clock clock;
  int most_iterations = 0;

 private:
  Timetable outputs_;
};

}  // namespace freshet::test
