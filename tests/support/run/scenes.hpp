// Scenes made in C++, and short runs of the real method on them without files or a run loop.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "src/methods/method.hpp"
#include "src/scene/toml/choices.hpp"

namespace freshet::test {

// Flat, frictionless, without walls; water as the caller sets it.
inline Scene bare_scene(int dimension, const freshet::Point& low, const freshet::Point& high,
                        double spacing) {
  Scene scene;
  scene.name = "test";
  scene.domain = {dimension, low, high};
  scene.water.spacing = spacing;
  scene.sph.eta = dimension == 1 ? 1.0 : 1.2;
  scene.sph.h_floor = std::pow(1.6, -1.0 / dimension);
  scene.end_time = 1e9;
  return scene;
}

// Walls on all sides of the domain.
inline void close_box(Scene& scene) {
  const auto [x0, y0] = scene.domain.low;
  const auto [x1, y1] = scene.domain.high;
  if (scene.domain.dimension == 1) scene.walls = {Wall{{{x0, 0}}}, Wall{{{x1, 0}}}};
  else scene.walls = {Wall{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}}};
}

// One of a list of choices, by the word that a scene would say.
template <class Choice>
Choice pick(const std::vector<Choice>& choices, const std::string& word) {
  for (const Choice& choice : choices)
    if (name_of(choice) == word) return choice;
  throw std::invalid_argument("no choice is called " + word);
}

// What the law of an open boundary imposes.
inline void impose(OpenBoundary& boundary, const std::string& what, Series series) {
  if (!input::has_key(boundary.law, what)) throw std::invalid_argument("its law imposes no " + what);
  if (auto* state = std::get_if<ImposedState>(&boundary.law); state && what != "velocity")
    state->above_bed = what == "depth";
  if (auto* open = std::get_if<Transmissive>(&boundary.law)) open->levelled = !series.t.empty();
  for (OpenBoundary::Imposed& i : boundary.imposed)
    if (i.what == what) return void(i.series = std::move(series));
  boundary.imposed.insert(what == "velocity" ? boundary.imposed.end() : boundary.imposed.begin(),
                          {what, "", std::move(series)});
}

inline void impose_if_known(OpenBoundary& boundary, const std::string& what, Series series) {
  if (input::has_key(boundary.law, what)) impose(boundary, what, std::move(series));
}

// An open boundary at x = x0 or x = x1 of the domain, all over it.
inline OpenBoundary open_end(const Scene& scene, bool left, const OpenLaw& law) {
  const auto [x0, y0] = scene.domain.low;
  const auto [x1, y1] = scene.domain.high;
  OpenBoundary boundary;
  boundary.name = left ? "left" : "right";
  const double low = scene.domain.dimension == 2 ? y0 : 0, high = scene.domain.dimension == 2 ? y1 : 1;
  if (left) boundary.line = {{x0, high}, {x0, low}};
  else boundary.line = {{x1, low}, {x1, high}};
  boundary.law = law;
  return boundary;
}

// Open on the left, walls elsewhere.
inline void open_left(Scene& scene, const OpenLaw& law, Series level) {
  const auto [x0, y0] = scene.domain.low;
  const auto [x1, y1] = scene.domain.high;
  const bool plane = scene.domain.dimension == 2;
  scene.boundaries = {open_end(scene, true, law)};
  impose_if_known(scene.boundaries[0], "level", std::move(level));
  scene.walls = {plane ? Wall{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}} : Wall{{{x1, 0}}}};
}

// Open at both ends, walls along the channel: the caller sets what is imposed.
inline void open_both(Scene& scene, const OpenLaw& left, const OpenLaw& right) {
  const auto [x0, y0] = scene.domain.low;
  const auto [x1, y1] = scene.domain.high;
  scene.boundaries = {open_end(scene, true, left), open_end(scene, false, right)};
  scene.walls.clear();
  if (scene.domain.dimension == 2) scene.walls = {Wall{{{x0, y0}, {x1, y0}}}, Wall{{{x1, y1}, {x0, y1}}}};
}

// A method and its clock. The tests' execution spaces share the host's memory.
struct Flow {
  std::unique_ptr<Method> method;
  double t = 0;
  long steps = 0;

  explicit Flow(const Scene& scene) : method(make_method(scene)) {}

  void step(double dt) {
    method->step(t, dt);
    t += dt;
    ++steps;
  }
  void many_steps(int count) {
    for (int n = 0; n < count; ++n) step(method->stable_dt());
  }
  // To t = end exactly; each(*this) after every step.
  void run(
      double end, const std::function<void()>& each = [] {}) {
    while (t < end) {
      step(std::min(method->stable_dt(), end - t));
      each();
    }
  }

  int size() const { return method->fields().size(); }
  Field<double> real(const char* name) const { return std::as_const(*method).fields().real(name); }
  // Values in the order of the ids (which must be 0 ... size - 1, as they are without open boundaries).
  std::vector<double> by_id(const char* name) const {
    const auto field = real(name);
    const auto id = std::as_const(*method).fields().integer("id");
    std::vector<double> values(static_cast<std::size_t>(size()));
    for (int i = 0; i < size(); ++i) values.at(static_cast<std::size_t>(id(i))) = field(i);
    return values;
  }
  double largest(const char* name) const {
    double most = 0;
    for (int i = 0; i < size(); ++i) most = std::max(most, std::abs(real(name)(i)));
    return most;
  }
  double largest_speed() const {
    const auto u = real("u"), v = method->dimension() == 2 ? real("v") : u;
    double most = 0;
    for (int i = 0; i < size(); ++i)
      most = std::max(most, method->dimension() == 2 ? std::hypot(u(i), v(i)) : std::abs(u(i)));
    return most;
  }
};

// sum of value(i)
template <class Value>
double sum(const Flow& flow, const Value& value) {
  double total = 0;
  for (int i = 0; i < flow.size(); ++i) total += value(i);
  return total;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = a.size() == b.size() ? 0 : 1e300;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    const double difference = std::abs(a[k] - b[k]);
    most = difference <= most ? most : difference;  // keeps a NaN
  }
  return most;
}

}  // namespace freshet::test
