// The modelled work of a step's launches, without that of walls and open boundaries. The counts of the pair
// passes hold for 2-D and the cubic spline; other scenes get what comes of the same counts, with their own
// numbers of pairs.
#include "src/methods/swe/solver.hpp"

namespace freshet::swe {

template <int D>
Cost ExplicitSph<D>::motion_cost() const {
  Cost cost = accelerate_cost;
  const auto add = [&](const Cost& part) {
    cost.particle_flops += part.particle_flops;
    cost.fields += part.fields;
  };
  if (bed_ && !scene_.sph.well_balanced) add(variational_ ? bed_cost : bed_slope_cost);
  if (friction_) add(friction_cost);
  return cost;
}

template <int D>
std::map<std::string, Work> ExplicitSph<D>::work() const {
  const double n = particles_.size();
  const Particles<D> p = bind();
  const double listed = neighbours_.mean_length(clusters_) * clusters_.size() * lanes;
  const double pairs =
      neighbours_.count_pairs<D>(clusters_, {p.x, p.h, order_.rows(), p.x, p.h, support_, 0});
  const auto walk = [&](const Cost& cost) { return work_of(cost, n, pairs, listed, lanes); };
  Work density = walk(gradient_ ? density_gradient_cost : density_rate_cost);
  density.flops += (report_.newton_mean - 1) * walk(density_again_cost).flops;
  return {{"cellgrid::extent", work_of(extent_cost, n)},
          {"cellgrid::count", work_of(count_cost, n)},
          {"cellgrid::place", work_of(place_cost, n)},
          {"cellgrid::permute", work_of(permute_cost, n)},
          {"cellgrid::list", walk(list_cost)},
          {"swe::density", density},
          {"swe::force", walk(internal_force_cost(stabilise_))},
          {"swe::kick_and_drift", work_of(kick_and_drift_cost, n)},
          {"swe::accelerate", work_of(motion_cost(), n)}};
}

template Cost ExplicitSph<1>::motion_cost() const;
template Cost ExplicitSph<2>::motion_cost() const;
template std::map<std::string, Work> ExplicitSph<1>::work() const;
template std::map<std::string, Work> ExplicitSph<2>::work() const;

}  // namespace freshet::swe
