// What the run loop asks of the state: totals, features, restart scalars.
#include "kernels/choice.hpp"
#include "kernels/linear/pair_product.hpp"
#include "src/methods/sisph/at_rest.hpp"
#include "src/methods/sisph/moving.hpp"
#include "src/text.hpp"

namespace freshet::sisph {
namespace {

double number(long value) { return static_cast<double>(value); }

}  // namespace

template <int D>
Totals SemiImplicitSph<D>::totals() const {
  Totals totals = passed_;
  const Field<double> mass = particles_.real("mass");
  const Field<int> kind = particles_.integer("kind");
  totals.mass = sum_of_particles<1>(
      "sisph::mass", particles_.size(),
      KOKKOS_LAMBDA(int i) { return Addends<1>{{kind(i) > 0 ? 0.0 : mass(i)}}; })[0];
  return totals;
}

template <int D>
Totals EulerianSph<D>::totals() const {
  Totals totals = Base::totals();
  if (!open_) return totals;
  // Where other sides are held, too, what passes there is counted, and no law tells how much it should be.
  const bool others = held_ > open_->size();
  const OpenFlux flux = others ? OpenFlux{unknown, unknown} : open_->flux();
  totals.flux = flux.net, totals.flux_gross = flux.gross;
  return totals;
}

template <int D>
std::map<std::string, Work> SemiImplicitSph<D>::work() const {
  const double n = particles_.size();
  return {{"sisph::product", product_work()},
          {"cg::residual", work_of(linear::residual_cost, n)},
          {"cg::advance", work_of(linear::advance_cost, n)},
          {"linear::follow", work_of(linear::follow_cost, n)}};
}

// With recomputed coefficients what a product computes hangs on where water stands: its particles alone.
template <int D>
Work EulerianSph<D>::product_work() const {
  if (scene_.sisph.recomputed) return work_of(Cost{}, particles_.size());
  return linear::work_of_slices(linear::product_cost, geometry_.pairs, active_.list());
}

template <int D>
Mechanics SemiImplicitSph<D>::mechanics() const {
  const Layer<D> now = water();
  const Field<double> mass = particles_.real("mass");
  const Field<int> kind = particles_.integer("kind");
  const double g = scene_.gravity;
  const auto sums = sum_of_particles<4>(
      "sisph::mechanics", particles_.size(), KOKKOS_LAMBDA(int i) {
        const Vec<double, D> v = at(now.v, i);
        const double h = now.depth(i), m = kind(i) > 0 ? 0.0 : mass(i);
        double across = 0;
        if constexpr (D == 2) across = v.y;
        return Addends<4>{{m * v.x, m * across, 0.5 * m * dot(v, v), m * g * (now.bed(i) + 0.5 * h)}};
      });
  return {{sums[0], sums[1]}, sums[2], sums[3]};
}

template <int D>
std::vector<std::string> SemiImplicitSph<D>::features_with(const std::vector<std::string>& formulation,
                                                           const std::vector<std::string>& sides) const {
  std::vector<std::string> names{name_of(scene_.sisph.kernel) + " kernel"};
  if (!scene_.sisph.exact_slopes) names.push_back("slopes normalised by Shepard's sum alone");
  names.insert(names.end(), formulation.begin(), formulation.end());
  if (bed_) names.push_back("bed");
  if (!scene_.walls.empty()) names.push_back("walls of mirror pairs");
  if (scene_.manning) names.push_back("friction, implicit");
  names.insert(names.end(), sides.begin(), sides.end());
  return names;
}

template <int D>
std::vector<std::string> EulerianSph<D>::features() const {
  std::vector<std::string> names{"particles at rest"}, sides;
  names.push_back(paths_ ? "velocity along particle paths" : "momentum carried by the mass fluxes");
  if (conservative_) names.push_back("conservative pressure");
  if (scene_.sisph.recomputed) names.push_back("coefficients found anew in every product");
  if (closure_.iterations > 0)
    names.push_back("pair areas closed in " + std::to_string(closure_.iterations) +
                    " iterations, largest change " + std::to_string(closure_.change));
  if (closure_.negative > 0) names.push_back(std::to_string(closure_.negative) + " pair areas below zero");
  const char* held = scene_.sisph.slip ? "" : "; walls hold the water";
  if (viscosity_) sides.push_back(std::string("viscosity, implicit") + held);
  const std::size_t lines = scene_.boundaries.size();
  if (open_) sides.push_back(std::to_string(lines) + " open " + (lines == 1 ? "boundary" : "boundaries"));
  if (held_ > (open_ ? open_->size() : 0)) sides.push_back("sides held at their state at t = 0");
  return Base::features_with(names, sides);
}

template <int D>
std::vector<std::string> LagrangianSph<D>::features() const {
  std::vector<std::string> sides;
  if (held_ > 0) sides.push_back("sides that go with the water beside them");
  const std::string path = name_of(scene_.sisph.path);
  return Base::features_with({"particles that move with the water, paths by " + path}, sides);
}

// What had to be done beyond the recipe.
template <int D>
std::vector<std::string> LagrangianSph<D>::notes() const {
  if (shortened_ == 0) return {};
  return {
      "steps were tried again with half their length " + std::to_string(shortened_) +
      " times: neighbours would have moved further than sisph.jump allows, or the surface did not settle"};
}

template <int D>
ScalarState SemiImplicitSph<D>::scalars() const {
  return {{"passed", {passed_.inflow, passed_.outflow}},
          {"solver",
           {number(report_.passes), number(report_.solves), number(report_.iterations),
            number(report_.unsettled), number(report_.newton_max)}}};
}

template <int D>
ScalarState EulerianSph<D>::scalars() const {
  ScalarState state = Base::scalars();
  if (open_) state["rim"] = open_->means(), state["rim_flux"] = open_->fluxes();
  state["mesh"] = {surface_.meshed() ? 1.0 : 0.0};
  return state;
}

template <int D>
ScalarState LagrangianSph<D>::scalars() const {
  ScalarState state = Base::scalars();
  state["moving"] = {moving_.jump(), last_dt_, moving_.meshed() ? 1.0 : 0.0, allowed_, number(shortened_)};
  return state;
}

template <int D>
void SemiImplicitSph<D>::restore(const ScalarState& state) {
  passed_.inflow = state.at("passed").at(0);
  passed_.outflow = state.at("passed").at(1);
  const std::vector<double>& solver = state.at("solver");
  report_.passes = static_cast<long>(solver.at(0));
  report_.solves = static_cast<long>(solver.at(1));
  report_.iterations = static_cast<long>(solver.at(2));
  report_.unsettled = static_cast<long>(solver.at(3));
  report_.newton_max = static_cast<int>(solver.at(4));
}

template <int D>
void EulerianSph<D>::restore(const ScalarState& state) {
  Base::restore(state);
  surface_.set_meshed(state.at("mesh").at(0) > 0);
  if (open_) open_->set_means(state.at("rim")), open_->set_fluxes(state.at("rim_flux"));
  Base::measure_speeds();
}

template <int D>
void LagrangianSph<D>::restore(const ScalarState& state) {
  Base::restore(state);
  const std::vector<double>& moving = state.at("moving");
  moving_.set_jump(moving.at(0));
  last_dt_ = moving.at(1);
  moving_.set_meshed(moving.at(2) > 0);
  allowed_ = moving.at(3);
  shortened_ = static_cast<long>(moving.at(4));
  settle_order();
  Base::measure_speeds();
}

template class SemiImplicitSph<1>;
template class SemiImplicitSph<2>;
template class EulerianSph<1>;
template class EulerianSph<2>;
template class LagrangianSph<1>;
template class LagrangianSph<2>;

}  // namespace freshet::sisph
