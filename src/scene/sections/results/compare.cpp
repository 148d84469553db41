// [compare]: the exact solution and how the errors against it are measured.
#include <cmath>

#include "src/reference/beach.hpp"
#include "src/reference/bump.hpp"
#include "src/reference/eddy.hpp"
#include "src/reference/exact.hpp"
#include "src/reference/radial.hpp"
#include "src/reference/riemann.hpp"
#include "src/reference/ritter.hpp"
#include "src/scene/sections/sections.hpp"
#include "src/scene/shapes/shapes.hpp"

namespace freshet::input {
namespace {

struct Solution {
  std::shared_ptr<const Exact> exact;
  std::string description;
  double shock_speed = 0;  // m/s, 0 = no shock
  // depth behind over depth ahead: particles of equal mass lie so much wider ahead
  double shock_cell_ratio = 1;
  bool steady = false;
};

Solution read_stoker(Table& table, const Scene& scene) {
  const double left = table.number("left", "m").positive().required(2);
  const double right =
      table.number("right", "m")
          .positive()
          .check([left](double depth) { return depth < left; }, "below 'left' (" + shown(left) + ")",
                 "the deep water of the Stoker solution is on the left")
          .required(1);
  const double dam = table.number("dam", "m").required();
  const double speed = right < left ? stoker_middle(left, right, scene.gravity).shock : 0;
  return {stoker(left, right, dam, scene.gravity),
          shown(left) + " m | " + shown(right) + " m, dam at " + shown(dam) + " m", speed, left / right};
}

Solution read_ritter(Table& table, const Scene& scene) {
  const double left = table.number("left", "m").positive().required(1);
  const double dam = table.number("dam", "m").required();
  return {ritter(left, dam, scene.gravity), shown(left) + " m | dry, dam at " + shown(dam) + " m"};
}

Bowl read_bowl(Table& table, const Scene& scene) {
  Bowl bowl{};
  bowl.depth0 = table.number("depth", "m").positive().required(1);
  bowl.radius = table.number("radius", "m").positive().required(1);
  const Point centre = table.point("centre", scene.domain.dimension).otherwise({0, 0});
  bowl.x0 = centre[0];
  bowl.y0 = centre[1];
  return bowl;
}

std::string described(const Bowl& bowl) {
  return "depth " + shown(bowl.depth0) + " m, radius " + shown(bowl.radius) + " m";
}

Solution read_planar(Table& table, const Scene& scene) {
  const Bowl bowl = read_bowl(table, scene);
  const double xi = table.number("xi", "m").positive().required(1);
  const bool plane = scene.domain.dimension == 1;
  return {plane ? thacker_sloshing(bowl, xi, scene.gravity) : thacker_planar(bowl, xi, scene.gravity),
          described(bowl) + ", xi = " + shown(xi) + " m"};
}

Solution read_radial(Table& table, const Scene& scene) {
  const Bowl bowl = read_bowl(table, scene);
  const auto inside = [](double a) { return a > 0 && a < 1; };
  const double amplitude =
      table.number("amplitude").check(inside, "between 0 and 1, both excluded").required(0.5);
  return {thacker_radial(bowl, amplitude, scene.gravity), described(bowl) + ", A = " + shown(amplitude)};
}

Solution read_rest(Table& table, const Scene& scene) {
  const double level = table.number("level", "m").required();
  return {still_water(level, scene.bed.elevation), "level " + shown(level) + " m", 0, 1, true};
}

Solution read_hump(Table& table, const Scene& scene) {
  GaussianHump hump{};
  hump.plane = scene.domain.dimension == 1;
  hump.level = table.number("level", "m").positive().required(1);
  hump.amplitude = table.number("amplitude", "m")
                       .check([&hump](double a) { return a > -hump.level; },
                              "above minus 'level' (" + shown(hump.level) + ")")
                       .required(0.1);
  hump.sigma = table.number("sigma", "m").positive().required(0.1);
  const Point centre = table.point("centre", scene.domain.dimension).otherwise({0, 0});
  hump.x0 = centre[0], hump.y0 = centre[1];
  const std::vector<double> flow = table.numbers("velocity", "numbers in m/s").otherwise({});
  if (!flow.empty()) hump.u = flow[0];
  if (flow.size() > 1) hump.v = flow[1];
  if (scene.bed.elevation) table.error("type", "the Gaussian hump has a flat bed", "leave out [bed]");
  return {gaussian_hump(hump, scene.gravity),
          shown(hump.amplitude) + " m on " + shown(hump.level) + " m, sigma = " + shown(hump.sigma) + " m"};
}

Solution read_eddy(Table& table, const Scene& scene) {
  Eddy turning;
  turning.level = table.number("level", "m").positive().required(1);
  const double fastest = std::sqrt(2 * scene.gravity * turning.level / std::exp(1.0));
  turning.speed = table.number("speed", "m/s")
                      .check([fastest](double v) { return std::abs(v) < fastest; },
                             "between -" + rounded(fastest) + " and " + rounded(fastest),
                             "a faster eddy of this depth has no water in its middle")
                      .required(0.1);
  turning.radius = table.number("radius", "m").positive().required(1);
  const Point centre = table.point("centre", scene.domain.dimension).otherwise({0, 0});
  turning.x0 = centre[0], turning.y0 = centre[1];
  if (scene.bed.elevation) table.error("type", "the eddy has a flat bed", "leave out [bed]");
  if (scene.domain.dimension == 1) table.error("type", "the eddy needs a 2-D domain");
  return {eddy(turning, scene.gravity), shown(turning.speed) + " m/s at " + shown(turning.radius) + " m, " +
                                            shown(turning.level) + " m deep"};
}

Solution read_riemann(Table& table, const Scene& scene) {
  const auto state = [&](const char* key) {
    Value<std::vector<double>> given = table.numbers(key, "two numbers: depth in m, velocity in m/s");
    const std::vector<double> numbers = given.required({1, 0});
    if (numbers.size() == 2 && numbers[0] > 0) return RiemannState{numbers[0], numbers[1]};
    given.fail("'" + table.path_of(key) + "' must be [depth, velocity] with a depth above 0");
    return RiemannState{1, 0};
  };
  const RiemannState left = state("left"), right = state("right");
  const double at = table.number("at", "m").otherwise(0);
  if (scene.bed.elevation) table.error("type", "the Riemann problem has a flat bed", "leave out [bed]");
  return {riemann(left, right, at, scene.gravity), shown(left.depth) + " m, " + shown(left.u) + " m/s | " +
                                                       shown(right.depth) + " m, " + shown(right.u) +
                                                       " m/s, at " + shown(at) + " m"};
}

Solution read_radial_dam(Table& table, const Scene& scene) {
  RadialDam dam{};
  dam.inner = table.number("inner", "m").positive().required(2);
  dam.outer =
      table.number("outer", "m")
          .at_least(0)
          .check([&dam](double depth) { return depth < dam.inner; },
                 "below 'inner' (" + shown(dam.inner) + ")", "the deep water of this solution is inside")
          .required(1);
  dam.radius = table.number("radius", "m").positive().required(1);
  const Point centre = table.point("centre", scene.domain.dimension).otherwise({0, 0});
  dam.x0 = centre[0];
  dam.y0 = centre[1];
  if (scene.bed.elevation) table.error("type", "the radial dam break has a flat bed", "leave out [bed]");
  if (scene.domain.dimension == 1) table.error("type", "the radial dam break needs a 2-D domain");
  return {radial_dam_break(dam, scene.gravity),
          shown(dam.inner) + " m within " + shown(dam.radius) + " m, " + shown(dam.outer) + " m outside"};
}

Solution read_beach(Table& table, const Scene& scene) {
  Beach beach{};
  beach.slope = table.number("slope").positive().required(0.1);
  beach.length = table.number("length", "m").positive().required(1);
  Value<std::vector<double>> humps =
      table.numbers("humps", "numbers, three to a hump: height, steepness, place");
  const std::vector<double> given = humps.required();
  if (given.size() % 3 != 0)
    humps.fail("'compare.exact.humps' has " + std::to_string(given.size()) + " numbers; each hump has three");
  for (std::size_t k = 0; k + 2 < given.size(); k += 3)
    beach.humps.push_back({given[k], given[k + 1], given[k + 2]});
  return {beach_wave(beach, scene.gravity), std::to_string(beach.humps.size()) + " humps on a slope of " +
                                                shown(beach.slope) + ", length " + shown(beach.length) +
                                                " m"};
}

Solution read_bump(Table& table, const Scene& scene) {
  const Bump bump{table.number("height", "m").positive().required(1), table.number("at", "m").required(),
                  table.number("half_width", "m").positive().required(1)};
  const BumpFlow flow{table.number("velocity", "m/s").positive().required(1),
                      table.number("inflow_depth", "m").positive().optional(),
                      table.number("outflow_depth", "m").positive().optional()};
  const auto exact = std::make_shared<SteadyBumpFlow>(bump, flow, scene.gravity);
  const std::string jump = exact->jump() ? ", jump at x = " + rounded(*exact->jump()) + " m" : "";
  return {exact, "q = " + rounded(exact->discharge()) + " m2/s" + jump};
}

Solution read_macdonald(Table& table, const Scene&) {
  const ChannelFlow flow = read_channel_flow(table);
  if (!flow.depth) return {};
  return {macdonald(flow), "q = " + shown(flow.discharge) + " m2/s"};
}

Solution read_exact(Table& table, const Scene& scene) {
  using Reader = Solution (*)(Table&, const Scene&);
  const Reader reader = table
                            .choice<Reader>("type", {{"stoker", read_stoker},
                                                     {"ritter", read_ritter},
                                                     {"thacker-planar", read_planar},
                                                     {"thacker-radial", read_radial},
                                                     {"radial-dam-break", read_radial_dam},
                                                     {"gaussian-hump", read_hump},
                                                     {"eddy", read_eddy},
                                                     {"riemann", read_riemann},
                                                     {"beach-wave", read_beach},
                                                     {"rest", read_rest},
                                                     {"bump", read_bump},
                                                     {"macdonald", read_macdonald}})
                            .required();
  if (!reader) {
    table.accept_rest();
    return {};
  }
  Solution solution = reader(table, scene);
  solution.description = table.text("type").required() + ": " + solution.description;
  return solution;
}

// A number of seconds, or { shock_cells = n }: the time in which the shock crosses n particles ahead of it. A
// particle's own error peaks as the shock passes it, so that the error against the exact solution swings with
// that period.
double read_window(Table& section, const Solution& solution, const Scene& scene) {
  if (!section.has_table("window")) return section.number("window", "s").at_least(0).otherwise(0);
  Table window = section.table("window");
  const double cells = window.number("shock_cells").positive().required(1);
  if (solution.shock_speed > 0) {
    const bool wider = scene.water.start == Water::Start::equal_mass;
    return cells * scene.water.spacing * (wider ? solution.shock_cell_ratio : 1) / solution.shock_speed;
  }
  if (solution.exact)
    window.error("shock_cells", "the exact solution has no shock to take 'shock_cells' from");
  return 0;
}

// Times at which all errors are taken too; read_time holds them against the end.
std::vector<double> read_times(Table& section) {
  Value<std::vector<double>> given = section.numbers("times", "times in s");
  const std::vector<double> times = given.otherwise({});
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] > (k > 0 ? times[k - 1] : 0)) continue;
    given.fail("'compare.times' holds " + shown(times[k]) + " as number " + std::to_string(k + 1) +
               "; the times must be above 0 and increase strictly");
    return {};
  }
  return times;
}

}  // namespace

ComparePlan read_compare(Table& section, Scene& scene) {
  Solution solution;
  {
    Table exact = section.table("exact");
    if (exact.given()) solution = read_exact(exact, scene);
    section.context().exact_failed = section.has("exact") && !solution.exact;
  }
  scene.compare.exact = solution.exact;
  scene.compare.description = solution.description;
  scene.compare.threshold = section.number("threshold", "m").at_least(0).otherwise(scene.compare.threshold);
  scene.compare.grid_spacing = section.number("grid", "m").positive().optional();
  scene.compare.samples = section.integer("samples").within(1, 10000).otherwise(scene.compare.samples);
  scene.compare.times = read_times(section);
  scene.compare.where = section.function("where").otherwise({});
  scene.compare.steady = section.boolean("steady").otherwise(solution.steady);
  for (const char* key : {"times", "where"})
    if (section.has(key) && !section.has("exact"))
      section.error(key, "'compare." + std::string(key) + "' needs an exact solution",
                    "name one as compare.exact");
  ComparePlan plan;
  plan.window = read_window(section, solution, scene);
  plan.around_end = section.choice<bool>("spread", {{"before", false}, {"around", true}}).otherwise(false);
  scene.compare.window = plan.window;
  return plan;
}

}  // namespace freshet::input
