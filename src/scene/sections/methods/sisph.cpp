// [sisph]: the semi-implicit method.
#include "src/scene/sections/sections.hpp"
#include "src/scene/toml/choices.hpp"

namespace freshet::input {
namespace {

void read_solver(Table& section, const std::string& key, Sisph::Solver& solver) {
  Table table = section.table(key);
  solver.tolerance = table.number("tolerance")
                         .positive()
                         .check([](double t) { return t < 1; }, "below 1")
                         .otherwise(solver.tolerance);
  solver.most = table.integer("max").at_least(1).otherwise(solver.most);
}

}  // namespace

// The explicit method's h / dx stands for l / dx wherever only a particle's size matters.
void read_sisph(Table& section, Scene& scene) {
  Sisph& sisph = scene.sisph;
  sisph.smoothing = section.number("smoothing").within(0.6, 4.0).otherwise(sisph.smoothing);
  sisph.kernel = section.choice("kernel", named<KernelChoice>()).otherwise(sisph.kernel);
  sisph.theta = section.number("theta").within(0.5, 1).otherwise(sisph.theta);
  sisph.picard = section.integer("picard").within(1, 20).otherwise(sisph.picard);
  sisph.momentum = section.choice("momentum", named(sisph::momentum_forms())).otherwise(sisph.momentum);
  sisph.closure = section.boolean("closure").otherwise(sisph.closure);
  sisph.exact_slopes = section.choice<bool>("correction", {{"krongauz-belytschko", true}, {"shepard", false}})
                           .otherwise(sisph.exact_slopes);
  sisph.recomputed = section.choice<bool>("coefficients", {{"stored", false}, {"recomputed", true}})
                         .otherwise(sisph.recomputed);
  sisph.moving =
      section.choice<bool>("formulation", {{"at-rest", false}, {"moving", true}}).otherwise(sisph.moving);
  sisph.path = section.choice("paths", named(sisph::particle_paths())).otherwise(sisph.path);
  sisph.jump = section.number("jump").within(0.01, 1).otherwise(sisph.jump);
  read_solver(section, "cg", sisph.cg);
  read_solver(section, "newton", sisph.newton);
  sisph.courant = section.number("courant").positive().otherwise(sisph.courant);
  sisph.advection = section.number("advection").positive().otherwise(sisph.advection);
  sisph.viscosity = section.number("viscosity").at_least(0).otherwise(sisph.viscosity);
  Value<bool> slip = section.boolean("slip");
  if (!slip.otherwise(sisph.slip) && sisph.viscosity == 0)
    slip.fail("water without viscosity slips along any wall",
              "name 'sisph.viscosity' in m2/s, or leave 'sisph.slip' out");
  sisph.slip = slip.otherwise(sisph.slip);
  if (scene.method == "sisph") scene.sph.eta = sisph.smoothing;
}

// What each formulation leaves to the other.
void check_formulation(Table& section, const Scene& scene) {
  if (scene.method != "sisph") return;
  const auto foreign = [&](const char* key, const std::string& belongs, const std::string& help) {
    if (section.has(key))
      section.error(key, "'sisph." + std::string(key) + "' is for particles " + belongs + " alone", help);
  };
  if (scene.time_step > 0 && section.has("courant"))
    section.context().notes.push_back("sisph.courant counts where the scene names no time.dt: the step is " +
                                      rounded(scene.time_step) + " s");
  if (scene.sisph.momentum.conservative && scene.sisph.picard < 2)
    section.error(
        "picard",
        "with one pass the conservative pressure acts on masses of another time and grows without bound",
        "sisph.picard = 2 or more, or another sisph.momentum");
  if (!scene.sisph.moving) {
    for (const char* key : {"paths", "jump"})
      foreign(key, "that move", "leave it out, or sisph.formulation = \"moving\"");
    return;
  }
  for (const char* key : {"momentum", "closure", "newton", "advection", "viscosity", "slip", "coefficients"})
    foreign(key, "at rest", "leave it out, or sisph.formulation = \"at-rest\"");
  const std::string help = "leave it out, or sisph.formulation = \"at-rest\"";
  if (!scene.boundaries.empty())
    section.error("formulation", "particles that move know no open boundaries ([[boundary]])", help);
}

}  // namespace freshet::input
