// perf_dispatch [PARTICLES]: what choices cost that a scene does not take, and what dry land costs. One flat,
// frictionless scene without walls is timed again and again, in turns with
//   again              itself: the noise of this machine
//   recipe             the same kernels called one after another, without the solver that could do more
//   dry                the same water in a domain 100 times as large
//   two ponds          half of it moved away by a fifth of its width; it has more shore
//   ponds              the same far apart, so that the box around the water is 100 times as large
//   canal, few sides   as much water in a long box with walls of 100 sides
//   canal, many sides  the same walls drawn in pieces of a spacing each, 10,000 of them for 40,000 particles
//   each feature       named: what it adds
// Prints ns per particle-step, in all and by kind of pass, the least of the turns, and exits with 1 where one
// of the first three is slower than the scene itself, ponds far apart than near ones, or many sides than few,
// by more than 5 % or three times the noise.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cellgrid/parallel/runtime.hpp"
#include "kernels/swe/density/density.hpp"
#include "kernels/swe/force/internal_force.hpp"
#include "kernels/swe/motion.hpp"
#include "src/methods/method.hpp"
#include "src/scene/place/place.hpp"

using namespace freshet;

namespace {

constexpr int turns = 9, steps = 10;
// x the stable time step: the water hardly spreads, whose thin edges would cost by their length
constexpr double slow = 0.05;
constexpr double margin = 0.05;  // of lists, as the solver's

// Shallow water at rest on a square of cells of 1 m, in a domain of `wider` times its width; `split`: half of
// the columns stand in the far corner.
Scene pond(int cells, double wider, bool split = false) {
  Scene scene;
  scene.name = "pond";
  scene.domain = {2, {0, 0}, {wider * cells, wider * cells}};
  scene.water.spacing = 1;
  scene.sph.h_floor = std::pow(1.6, -0.5);
  scene.end_time = 1e9;
  const double half = 0.5 * cells, shift = (wider - 1) * cells, full = cells;
  const auto near = [=](double x, double y) {
    return x > 0 && x < (split ? half : full) && y > 0 && y < full;
  };
  scene.water.depth = [=](double x, double y) {
    const bool wet =
        near(x, y) || (split && x > shift + half && x < shift + full && y > shift && y < shift + full);
    return wet ? 1 + 0.05 * std::sin(0.2 * x) * std::cos(0.3 * y) : 0.0;
  };
  return scene;
}

// A closed canal, 8 cells of 1 m wide. Its walls are drawn in pieces of a cell each, or in 48 along and 2
// across: the points behind them are the same.
Scene canal(int particles, bool many_sides) {
  constexpr int width = 8, few = 48;
  const int length =
      few * std::max(1, static_cast<int>(std::lround(static_cast<double>(particles) / (width * few))));
  Scene scene = pond(1, 1);
  scene.domain = {2, {0, 0}, {1.0 * length, 1.0 * width}};
  scene.water.depth = [](double x, double y) { return 1 + 0.05 * std::sin(0.2 * x) * std::cos(0.3 * y); };
  std::vector<Point> line{{0, 0}};
  const auto draw = [&line](double x, double y, int pieces) {
    const Point from = line.back();
    for (int k = 1; k <= pieces; ++k)
      line.push_back({from[0] + (x - from[0]) * k / pieces, from[1] + (y - from[1]) * k / pieces});
  };
  const int along = many_sides ? length : few, across = many_sides ? width : 2;
  draw(length, 0, along), draw(length, width, across), draw(0, width, along), draw(0, 0, across);
  scene.walls = {Wall{line}};
  return scene;
}

// Where the time of the launches goes, by the kind of pass.
enum Pass { order, list, density, force, rest, pass_count };
double spent[pass_count];
Pass running = rest;
std::chrono::steady_clock::time_point began;

Pass pass_of(const std::string& label) {
  if (label == "cellgrid::list") return list;
  if (label.rfind("cellgrid::", 0) == 0) return order;
  if (label == "swe::density") return density;
  return label == "swe::force" ? force : rest;
}

void watch_launches() {
  const auto begin = [](const char* label, const uint32_t, uint64_t*) {
    running = pass_of(label);
    began = std::chrono::steady_clock::now();
  };
  const auto end = [](const uint64_t) {
    spent[running] += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  using namespace Kokkos::Tools::Experimental;
  set_begin_parallel_for_callback(begin), set_end_parallel_for_callback(end);
  set_begin_parallel_reduce_callback(begin), set_end_parallel_reduce_callback(end);
  set_begin_parallel_scan_callback(begin), set_end_parallel_scan_callback(end);
}

// Something that is stepped.
struct Stepped {
  std::function<void()> step;
  std::function<int()> particles;
};

double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

// Made anew for each turn: where its memory lies costs more or less.
struct Variant {
  std::string name;
  std::function<Stepped()> make;
  int against = -1;  // the row that it must not be slower than
  int particles = 0;
  std::vector<double> times{};  // ns per particle and step
  std::array<std::vector<double>, pass_count> passes{};

  void take_turn() {
    const Stepped made = make();
    for (int n = 0; n < 3; ++n) made.step();
    for (double& s : spent) s = 0;
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < steps; ++n) made.step();
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
    particles = made.particles();
    const double per = 1e9 / (static_cast<double>(steps) * particles);
    times.push_back(per * whole.count());
    for (std::size_t k = 0; k < pass_count; ++k) passes[k].push_back(per * spent[k]);
  }
};

Variant solver(const std::string& name, const Scene& scene, int against = -1) {
  const auto make = [scene] {
    const std::shared_ptr<Method> method = make_method(scene);
    return Stepped{[method] { method->step(0, slow * method->stable_dt()); },
                   [method] { return method->fields().size(); }};
  };
  return {name, make, against};
}

// A step of a flat scene and nothing else: the calls that swe::ExplicitSph makes for it.
class Recipe {
 public:
  explicit Recipe(const Scene& scene)
      : method_(make_method(scene)), fields_(method_->fields()),
        order_(2, scene.water.spacing, sorted_box(scene)), sph_(scene.sph), gravity_(scene.gravity),
        kernel_(make_kernel<2>(scene.sph.kernel, scene.sph.eta, false)), dt_(slow * method_->stable_dt()) {}

  void step() {
    const LengthBounds bounds{sph_.h_floor, sph_.h_cap};
    swe::kick_and_drift<2>(bind(), {gravity_, bounds, {}, {}, {}, {}}, fields_.size(), dt_);
    order_.sort(fields_);
    clusters_.cut(order_.rows());
    const swe::Particles<2> p = bind();
    order_.measure_reach(fields_, p.h, 2 * (1 + margin));
    list_.build<2>(clusters_, {p.x, p.h, order_.rows(), p.x, p.h, 2, margin});
    swe::solve_density<2>(kernel_, clusters_, list_.view(), {}, p, {},
                          {gravity_, sph_.newton_tolerance, margin, bounds, true, 1, 0.5});
    swe::internal_force<2>(kernel_, clusters_, list_.view(), {}, p, swe::LaxFriedrichsMuscl{1});
    dt_ = slow * 0.4 *
          swe::accelerate_and_kick<2>(p, {gravity_, bounds, {}, {}, {}, {}}, fields_.size(), 0.5 * dt_);
  }
  int particles() const { return fields_.size(); }

 private:
  using LengthBounds = swe::LengthBounds;

  swe::Particles<2> bind() const {
    const auto f = [&](const char* name) { return fields_.real(name); };
    return {{f("x"), f("y")},
            {f("u"), f("v")},
            {f("u_pred"), f("v_pred")},
            {f("ax"), f("ay")},
            f("mass"),
            f("h0"),
            f("kh"),
            f("depth"),
            f("depth_rate"),
            f("depth_growth"),
            f("h"),
            f("inv_h"),
            f("pressure"),
            f("celerity"),
            f("weight"),
            {f("strain_xx"), f("strain_xy"), f("strain_yy")},
            {},
            {f("tx"), f("ty")},
            f("signal"),
            fields_.integer("id"),
            {}};
  }

  std::unique_ptr<Method> method_;  // holds the fields, as the scene starts
  FieldSet& fields_;
  RowOrder order_;
  ClusterSet clusters_;
  NeighbourList list_;
  Sph sph_;
  double gravity_;
  AnyKernel<2> kernel_;
  double dt_;
};

Variant recipe(const Scene& scene) {
  const auto make = [scene] {
    const auto made = std::make_shared<Recipe>(scene);
    return Stepped{[made] { made->step(); }, [made] { return made->particles(); }};
  };
  return {"recipe", make, 0};
}

// The scene with one thing named.
std::vector<Variant> features(int cells) {
  std::vector<Variant> all;
  const auto add = [&](const char* name, const std::function<void(Scene&)>& change) {
    Scene scene = pond(cells, 1);
    change(scene);
    all.push_back(solver(name, scene));
  };
  const double w = cells;
  add("no stabilisation", [](Scene& s) { s.sph.stabilisation = swe::NoStabilisation{}; });
  add("Lax-Friedrichs, plain", [](Scene& s) { s.sph.stabilisation = swe::LaxFriedrichs{}; });
  add("two-shock, MUSCL", [](Scene& s) { s.sph.stabilisation = swe::TwoShockMuscl{}; });
  add("fixed h", [](Scene& s) { s.sph.h_floor = s.sph.h_cap = 1; });
  add("bed", [](Scene& s) {
    s.bed.elevation = [](double x, double y) { return 0.05 * std::sin(0.1 * x + 0.1 * y); };
  });
  add("friction", [](Scene& s) { s.manning = 0.02; });
  add("walls, mirror", [w](Scene& s) { s.walls = {Wall{{{0, 0}, {w, 0}, {w, w}, {0, w}, {0, 0}}}}; });
  add("walls, rows", [w](Scene& s) {
    s.walls = {Wall{{{0, 0}, {w, 0}, {w, w}, {0, w}, {0, 0}}}};
    s.sph.walls = WallKind::image_rows;
  });
  add("splitting, none due", [](Scene& s) {
    s.split = Split{};
    s.split->alpha = 0.92, s.split->eps = 0.36, s.split->area.elsewhere = 1e6;
  });
  return all;
}

int report(const std::vector<Variant>& all) {
  const double flat = least(all[0].times), noise = std::abs(least(all[1].times) / flat - 1),
               allowed = std::max(0.05, 3 * noise);
  int slower = 0;
  std::printf("%-24s %9s %8s %8s %8s %8s %8s %8s %8s\n", "", "particles", "ns", "of flat", "order", "list",
              "density", "force", "rest");
  for (const Variant& v : all) {
    const double ratio = least(v.times) / flat;
    const bool too_slow =
        v.against >= 0 &&
        least(v.times) > (1 + allowed) * least(all[static_cast<std::size_t>(v.against)].times);
    slower += too_slow;
    std::printf("%-24s %9d %8.1f %8.3f", v.name.c_str(), v.particles, least(v.times), ratio);
    for (const auto& pass : v.passes) std::printf(" %8.1f", least(pass));
    std::printf("%s\n", too_slow ? "  too slow" : "");
  }
  std::printf(
      "%s, %d threads; ns per particle-step, least of %d turns of %d steps; judged: rows 2 to 4 against the "
      "first, 6 against 5, 8 against 7, "
      "allowed 1 + %.3f\n",
      backend_name(), thread_count(), turns, steps, allowed);
  return slower > 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int wanted = argc > 1 ? std::atoi(argv[1]) : 40000,
            cells = 2 * static_cast<int>(std::sqrt(std::max(wanted, 400)) / 2);
  const char* threads = std::getenv("OMP_NUM_THREADS");
  const Runtime kokkos(threads ? std::atoi(threads) : 1);
  watch_launches();
  std::vector<Variant> all{solver("flat", pond(cells, 1)),
                           solver("again", pond(cells, 1), 0),
                           recipe(pond(cells, 1)),
                           solver("dry, 100 times the area", pond(cells, 10), 0),
                           solver("two ponds", pond(cells, 1.2, true)),
                           solver("ponds, 100 times the box", pond(cells, 10, true), 4),
                           solver("canal, few sides", canal(cells * cells, false)),
                           solver("canal, many sides", canal(cells * cells, true), 6)};
  for (Variant& v : features(cells)) all.push_back(std::move(v));
  for (int turn = 0; turn < turns; ++turn)
    for (Variant& v : all) v.take_turn();
  return report(all);
}
