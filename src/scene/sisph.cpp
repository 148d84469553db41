// [sisph]: the semi-implicit method.
#include "src/scene/names.hpp"
#include "src/scene/sections.hpp"

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
  sisph.kernel = section.choice<KernelName>("kernel", kernel_names()).otherwise(sisph.kernel);
  sisph.theta = section.number("theta").within(0.5, 1).otherwise(sisph.theta);
  sisph.picard = section.integer("picard").within(1, 20).otherwise(sisph.picard);
  sisph.momentum = section.choice<Sisph::Momentum>("momentum", momentum_names()).otherwise(sisph.momentum);
  sisph.closure = section.boolean("closure").otherwise(sisph.closure);
  sisph.correction = section.choice<Sisph::Correction>("correction", correction_names()).otherwise(sisph.correction);
  sisph.coefficients = section.choice<Sisph::Coefficients>("coefficients", coefficient_names()).otherwise(sisph.coefficients);
  sisph.formulation = section.choice<Sisph::Formulation>("formulation", formulation_names()).otherwise(sisph.formulation);
  sisph.paths = section.choice<Sisph::Paths>("paths", path_names()).otherwise(sisph.paths);
  sisph.jump = section.number("jump").within(0.01, 1).otherwise(sisph.jump);
  read_solver(section, "cg", sisph.cg);
  read_solver(section, "newton", sisph.newton);
  sisph.courant = section.number("courant").positive().otherwise(sisph.courant);
  sisph.advection = section.number("advection").positive().otherwise(sisph.advection);
  sisph.viscosity = section.number("viscosity").at_least(0).otherwise(sisph.viscosity);
  Value<bool> slip = section.boolean("slip");
  if (!slip.otherwise(sisph.slip) && sisph.viscosity == 0)
    slip.fail("water without viscosity slips along any wall", "name 'sisph.viscosity' in m2/s, or leave 'sisph.slip' out");
  sisph.slip = slip.otherwise(sisph.slip);
  if (scene.method == "sisph") scene.sph.eta = sisph.smoothing;
}

// What each formulation leaves to the other.
void check_formulation(Table& section, const Scene& scene) {
  if (scene.method != "sisph") return;
  const auto foreign = [&](const char* key, const std::string& belongs, const std::string& help) {
    if (section.has(key)) section.error(key, "'sisph." + std::string(key) + "' is for particles " + belongs + " alone", help);
  };
  if (scene.time_step > 0 && section.has("courant"))
    section.context().notes.push_back("sisph.courant counts where the scene names no time.dt: the step is " + rounded(scene.time_step) + " s");
  if (scene.sisph.momentum == Sisph::Momentum::conservative && scene.sisph.picard < 2)
    section.error("picard", "with one pass the conservative pressure acts on masses of another time and grows without bound",
                  "sisph.picard = 2 or more, or another sisph.momentum");
  if (scene.sisph.formulation == Sisph::Formulation::at_rest) {
    for (const char* key : {"paths", "jump"}) foreign(key, "that move", "leave it out, or sisph.formulation = \"moving\"");
    return;
  }
  for (const char* key : {"momentum", "closure", "newton", "advection", "viscosity", "slip", "coefficients"})
    foreign(key, "at rest", "leave it out, or sisph.formulation = \"at-rest\"");
  const std::string help = "leave it out, or sisph.formulation = \"at-rest\"";
  if (!scene.boundaries.empty()) section.error("formulation", "particles that move know no open boundaries ([[boundary]])", help);
}

}  // namespace freshet::input
