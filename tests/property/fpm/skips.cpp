// Incompressible flow: what the scene does not name is neither launched nor allocated, and a step makes no
// memory.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/support/run/flow.hpp"
#include "tests/support/watch/recording.hpp"

using namespace freshet;

namespace {

using Names = std::set<std::string>;

// The fourth step's launches but for the iterations of the solvers, whose number is not the scene's.
Names labels_of(const std::string& scene, const std::vector<std::string>& overrides) {
  test::FlowRun run(scene, overrides);
  const double dt = run.solver.stable_dt();
  run.steps(3, dt);
  const test::Recording recording;
  run.steps(1, dt);
  Names names;
  const auto iterated = [](const std::string& label) {  // or of the levels of a cycle
    for (const char* solver : {"bicgstab::", "linear::", "box_multigrid::"})
      if (label.rfind(solver, 0) == 0) return true;
    return std::set<std::string>{"mesh_correction::to_nodes", "mesh_correction::add_rows",
                                 "mesh_correction::from_nodes"}
               .count(label) > 0;
  };
  for (const auto& label : recording.labels())
    if (!iterated(label)) names.insert(label);
  return names;
}

Names minus(Names a, const Names& b) {
  for (const auto& name : b) a.erase(name);
  return a;
}

const std::vector<std::string> inviscid{"fluid.viscosity=0"}, viscous{"fluid.viscosity=1e-3"},
    implicit{"fluid.viscosity=1e-3", "fpm.diffusion=implicit"};

}  // namespace

TEST_CASE("skips: an incompressible step has the launches of its recipe") {
  Names expected{
      "fpm::advect",        "fpm::hold",       "fpm::voronoi",        "fpm::partners",    "fpm::decide",
      "fpm::merged_places", "fpm::new_places", "fpm::hold_velocity",  "fpm::list",        "fpm::stencils",
      "fpm::find_rows",     "fpm::fit",        "fpm::guess_pressure", "fpm::predict",     "fpm::sources",
      "fpm::unknowns",      "fpm::rows",       "fpm::right_side",     "fpm::correct",     "fpm::new_state",
      "fpm::smooth_edges",  "fpm::hold_edges", "fpm::remember_air",   "fpm::limit_spray", "fpm::speed"};
  for (const char* made : {"places", "masses", "add_masses", "conductances", "add_conductances"})
    expected.insert(std::string("mesh_correction::") + made);
  for (const char* sorted : {"extent", "mark", "keep", "clear", "count", "scan", "place", "settle", "permute",
                             "count_clusters", "cut_clusters"})
    expected.insert(std::string("cellgrid::") + sorted);
  CHECK(labels_of("fpm_still_box", inviscid) == expected);
}

TEST_CASE(
    "skips: explicit viscosity adds no launch, the implicit one its own, a closed domain those that take the "
    "mean off") {
  const Names bare = labels_of("fpm_still_box", inviscid);
  CHECK(labels_of("fpm_still_box", viscous) == bare);
  CHECK(minus(labels_of("fpm_still_box", implicit), bare) ==
        Names{"fpm::viscous_rows", "fpm::viscous_side", "fpm::viscous_multiply", "fpm::viscous_result"});
  const Names closed =
      labels_of("fpm_taylor_green", {"water.spacing=0.05", "fluid.viscosity=0", "body.0.velocity=[0, 0]"});
  CHECK(minus(closed, bare) == Names{"fpm::mean", "fpm::add_mean", "fpm::take_mean", "point_mesh::weight"});
  CHECK(minus(bare, closed) == Names{});
}

TEST_CASE("skips: the plain scheme fits no pressure, the printed ones hold the walls") {
  const Names bare = labels_of("fpm_still_box", inviscid);
  CHECK(minus(bare, labels_of("fpm_still_box", {"fluid.viscosity=0", "fpm.scheme=plain"})) ==
        Names{"fpm::fit", "fpm::smooth_edges", "fpm::hold_edges"});
  CHECK(minus(labels_of("fpm_still_box", {"fluid.viscosity=0", "fpm.scheme=projection"}), bare) ==
        Names{"fpm::hold_walls"});
}

TEST_CASE("skips: incompressible steps make no memory once their lists have grown") {
  const auto overrides = GENERATE(inviscid, viscous, implicit);
  test::FlowRun run("fpm_still_box", overrides);
  run.steps(5, run.solver.stable_dt());
  const test::Recording recording;
  run.steps(5, run.solver.stable_dt());
  CHECK(recording.allocations == std::vector<std::string>{});
}

TEST_CASE("skips: implicit viscosity that is zero changes nothing, to the bit") {
  test::FlowRun plain("fpm_martin_moyce", {"water.spacing=0.0057", "fluid.viscosity=0"});
  test::FlowRun asked("fpm_martin_moyce",
                      {"water.spacing=0.0057", "fluid.viscosity=0", "fpm.diffusion=implicit"});
  plain.run_to(0.02), asked.run_to(0.02);
  const auto a = plain.points(), b = asked.points();
  REQUIRE(a.size() == b.size());
  bool same = true;
  for (std::size_t k = 0; k < a.size(); ++k)
    same = same && a[k].x == b[k].x && a[k].v == b[k].v && a[k].p == b[k].p;
  CHECK(same);
}
