// A method without physics for tests of the run loop: particles fly in a box, bounce off its sides, and carry
// a depth that depends on their whole history, so that any state lost on a restart shows. One thread of
// control decides everything.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "src/methods/method.hpp"
#include "src/reference/exact.hpp"
#include "src/scene/place/place.hpp"

namespace freshet::test {

struct Trouble {
  enum class Kind { none, not_a_number, infinite, negative_depth, fast, lost, leak, no_dt } kind = Kind::none;
  long step = 0;  // happens in this step
  int id = 0;     // to this particle
};

class FakeMethod : public Method {
 public:
  std::function<void(long)> on_step;  // called at the end of every step, with its number
  Trouble trouble;
  StepReport strained;  // what every step reports

  explicit FakeMethod(const Scene& scene)
      : scene_(scene), fields_(0), order_(scene.domain.dimension, scene.water.spacing, sorted_box(scene)) {
    const double dx = scene.water.spacing;
    const auto cells = [&](std::size_t a) {
      return static_cast<int>(std::lround((scene.domain.high[a] - scene.domain.low[a]) / dx));
    };
    const int columns = cells(0), rows = two_d() ? cells(1) : 1;
    fields_.resize(columns * rows);
    make_fields();
    for (int i = 0; i < fields_.size(); ++i) place(i, i % columns, i / columns);
  }

  std::string name() const override { return "fake"; }
  int dimension() const override { return scene_.domain.dimension; }
  double stable_dt() const override {
    if (trouble.kind == Trouble::Kind::no_dt && steps_ >= trouble.step) return 0;
    return 0.3 * scene_.water.spacing * (1 + 0.3 * std::sin(phase_));
  }

  void step(double, double dt) override {
    ++steps_;
    phase_ += 1.7 * dt / scene_.water.spacing;
    for (int i = 0; i < fields_.size(); ++i) advance(i, dt);
    if (steps_ % 4 == 0) shuffle();
    if (trouble.step == steps_) spoil();
    if (on_step) on_step(steps_);
  }

  FieldSet& fields() override { return fields_; }
  const FieldSet& fields() const override { return fields_; }

  const Rows& rows() const override {  // sorting changes the order in memory alone
    order_.sort(fields_);
    order_.measure_reach(fields_, get("h"), 2);
    return order_.rows();
  }

  Totals totals() const override {
    Totals totals;
    for (int i = 0; i < fields_.size(); ++i) totals.mass += get("mass")(i);
    return totals;
  }
  Mechanics mechanics() const override {
    Mechanics m;
    for (int i = 0; i < fields_.size(); ++i) m.kinetic += 0.5 * get("mass")(i) * get("u")(i) * get("u")(i);
    return m;
  }
  StepReport report() const override { return strained; }

  std::vector<PointState> sample(const std::vector<Point>& points) const override {
    std::vector<PointState> states;
    for (const auto& point : points) states.push_back(state_at(point));
    return states;
  }

  void raise_wet_levels(const Shores& shores) const override {
    for (std::size_t k = 0; k < shores.shore.extent(0); ++k) {
      const ShorePlace& shore = shores.shore(k);
      WetLevels& highest = shores.highest(k);
      for (int i = 0; i < fields_.size(); ++i) {
        if (distance(i, {shore.x, shore.y}) <= shore.radius && get("depth")(i) >= shore.min_depth)
          highest.bed = highest.line = std::max(highest.bed, get("bed")(i));
      }
    }
  }

  std::vector<std::string> features() const override { return {"flight"}; }
  ScalarState scalars() const override {
    return {{"phase", {phase_}}, {"steps", {static_cast<double>(steps_)}}};
  }
  void restore(const ScalarState& scalars) override {
    phase_ = scalars.at("phase").at(0);
    steps_ = std::lround(scalars.at("steps").at(0));
  }

 private:
  bool two_d() const { return scene_.domain.dimension == 2; }
  // The tests' execution spaces share the host's memory.
  Field<double> get(const char* field) const { return fields_.real(field); }
  Field<int> id() const { return fields_.integer("id"); }

  void make_fields() {
    for (const char* name : {"x", "bed", "depth", "h"}) fields_.real(name, "m", Carry::state);
    fields_.real("u", "m/s", Carry::state);
    if (two_d()) {
      fields_.real("y", "m", Carry::state);
      fields_.real("v", "m/s", Carry::state);
    }
    fields_.real("mass", "m3", Carry::state);
    fields_.real("scratch", "1", Carry::no);
    fields_.integer("id", "1", Carry::state);
  }

  void place(int i, int column, int row) {
    const double dx = scene_.water.spacing;
    get("x")(i) = scene_.domain.low[0] + (column + 0.5) * dx;
    get("u")(i) = std::sin(1.0 + i);
    if (two_d()) {
      get("y")(i) = scene_.domain.low[1] + (row + 0.5) * dx;
      get("v")(i) = std::cos(2.0 + 3 * i);
    }
    get("depth")(i) = 1 + 0.1 * std::sin(0.3 * i);
    get("bed")(i) = 0.1 * get("x")(i);
    get("mass")(i) = dx * (two_d() ? dx : 1);
    get("h")(i) = 1.2 * dx;
    get("scratch")(i) = std::numeric_limits<double>::quiet_NaN();  // nobody may look at it
    id()(i) = i;
  }

  void bounce(Field<double> x, Field<double> u, int i, std::size_t axis, double dt) {
    x(i) += dt * u(i);
    if (x(i) < scene_.domain.low[axis]) u(i) = std::abs(u(i));
    if (x(i) > scene_.domain.high[axis]) u(i) = -std::abs(u(i));
  }

  void advance(int i, double dt) {
    bounce(get("x"), get("u"), i, 0, dt);
    if (two_d()) bounce(get("y"), get("v"), i, 1, dt);
    get("depth")(i) *= 1 + 0.01 * dt * std::sin(phase_ + get("x")(i));
    get("bed")(i) = 0.1 * get("x")(i);
  }

  // Particles change places in memory as a real sort moves them.
  void shuffle() {
    const Field<int> order("order", static_cast<std::size_t>(fields_.size()));
    for (int i = 0; i < fields_.size(); ++i) order(i) = (i + 1) % fields_.size();
    fields_.permute(order, fields_.size());
  }

  int index_of(int wanted) const {
    for (int i = 0; i < fields_.size(); ++i) {
      if (id()(i) == wanted) return i;
    }
    return -1;
  }

  std::vector<int> by_id() const {
    std::vector<int> places(static_cast<std::size_t>(fields_.size()));
    for (int i = 0; i < fields_.size(); ++i) places[static_cast<std::size_t>(id()(i))] = i;
    return places;
  }

  void spoil() {
    const int i = index_of(trouble.id);
    using Kind = Trouble::Kind;
    if (trouble.kind == Kind::not_a_number) get("u")(i) = std::numeric_limits<double>::quiet_NaN();
    if (trouble.kind == Kind::infinite) get("depth")(i) = std::numeric_limits<double>::infinity();
    if (trouble.kind == Kind::negative_depth) get("depth")(i) = -1e-3;
    if (trouble.kind == Kind::fast) get("u")(i) = 2 * scene_.limits.speed;
    if (trouble.kind == Kind::lost) get("x")(i) = scene_.domain.high[0] + 100 * scene_.water.spacing;
    if (trouble.kind == Kind::leak) get("mass")(i) *= 0.5;
  }

  double distance(int i, const Point& at) const {
    return std::hypot(get("x")(i) - at[0], two_d() ? get("y")(i) - at[1] : 0);
  }

  PointState state_at(const Point& point) const {
    PointState state;
    state.bed = 0.1 * point[0];
    double sum = 0, weights = 0;
    for (const int i : by_id()) {  // whoever asks for rows() changes the order in memory
      const double w = std::max(0.0, 2 - distance(i, point) / get("h")(i));
      sum += w * get("depth")(i);
      weights += w;
    }
    state.reached = weights > 0;
    if (state.reached) state.depth = sum / weights;
    return state;
  }

  Scene scene_;
  mutable FieldSet fields_;
  mutable RowOrder order_;
  double phase_ = 0;
  long steps_ = 0;
};

// A box of 1 m (1-D) or 1 m x 1 m with 20 particles a side, a gauge, a run-up point and outputs.
inline Scene fake_scene(int dimension = 2) {
  Scene scene;
  scene.name = "fake";
  scene.method = "fake";
  scene.text = "name = \"fake\"\n";
  scene.end_time = 1;
  scene.domain.dimension = dimension;
  scene.water.spacing = 0.05;
  scene.output.every = 0.25;
  scene.output.gauges_every = 0.013;
  scene.limits.speed = 10;
  Gauge gauge;
  gauge.name = "middle";
  gauge.at = {0.5, 0.5};
  scene.gauges = {gauge};
  RunUp run_up;
  run_up.name = "shore";
  run_up.at = {0.9, 0.5};
  run_up.radius = 0.1;
  scene.run_ups = {run_up};
  return scene;
}

// The same with everything asked for that can be observed; whatever can be measured is.
inline Scene observed_scene(int dimension = 2) {
  Scene scene = fake_scene(dimension);
  scene.gauges[0].measured = Series{{0, 1}, {1, 1.1}};
  Transect line;
  line.name = "line", line.line = {{{0.1, 0.5}, {0.9, 0.5}}}, line.one_dimensional = dimension == 1;
  line.time = 0.27, line.spacing = 0.1;
  scene.profiles = {line};
  scene.compare.exact = stoker(2, 1, 0.5, 9.81);
  scene.compare.samples = 3, scene.compare.window = 0.3;
  scene.compare.times = {0.1, 0.4};
  scene.compare.steady = true;
  scene.rasters = Rasters{};
  scene.rasters->spacing = 0.1, scene.rasters->every = 0.15;
  scene.rasters->what = {Rasters::Quantity::depth, Rasters::Quantity::surface};
  scene.rasters->maxima = true;
  return scene;
}

}  // namespace freshet::test
