// The passes that are benchmarked: what each runs, what has to be done before each run of it (not timed), and
// its modelled work.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "perf/water.hpp"

namespace freshet::perf {

struct Pass {
  std::string name;
  std::function<void()> prepare, run;
  std::function<Work()> work;  // of a run, after it
};

inline Work add(Work a, const Work& b, double times = 1) {
  a.flops += times * b.flops;
  a.bytes += times * b.bytes;
  return a;
}

struct NamedStabilisation {
  const char* name;
  swe::AnyStabilisation value;
};

inline std::vector<NamedStabilisation> stabilisations() {
  return {{"none", swe::NoStabilisation{}},   {"viscosity", swe::ArtificialViscosity{0.1, 0}},
          {"lf", swe::LaxFriedrichs{1}},      {"lf_muscl", swe::LaxFriedrichsMuscl{1}},
          {"two_shock", swe::TwoShock{9.81}}, {"two_shock_muscl", swe::TwoShockMuscl{9.81}}};
}

// All passes over the given water; beds, friction and walls are added to copies of their own kind by the
// caller.
class PassList {
 public:
  explicit PassList(std::shared_ptr<Water> water) : w_(std::move(water)) {}

  std::vector<Pass> plain() const {
    std::vector<Pass> passes{sort(), list(), density("density")};
    for (const NamedStabilisation& s : stabilisations())
      passes.push_back(force(std::string("force/") + s.name, s.value));
    passes.push_back(
        {"kick_and_drift", none(), [w = w_] { w->kick_and_drift(0); }, o_n(swe::kick_and_drift_cost)});
    passes.push_back({"accelerate", none(), [w = w_] { w->accelerate(0); }, o_n(swe::accelerate_cost)});
    return passes;
  }

  std::vector<Pass> with_bed() const {
    Cost cost = swe::accelerate_cost;
    cost.particle_flops += swe::bed_cost.particle_flops, cost.fields += swe::bed_cost.fields;
    return {{"accelerate_bed", none(), [w = w_] { w->accelerate(0); }, o_n(cost)}};
  }

  std::vector<Pass> with_friction() const {
    Cost cost = swe::accelerate_cost;
    cost.particle_flops += swe::friction_cost.particle_flops, cost.fields += swe::friction_cost.fields;
    return {{"accelerate_friction", none(), [w = w_] { w->accelerate(0); }, o_n(cost)}};
  }

  std::vector<Pass> with_matrix() const {
    return {{"matvec", none(), [w = w_] { w->multiply(); },
             [w = w_] { return work_of_entries(matvec_cost, w->size(), w->entries()); }}};
  }

  // The work is that without walls: what they cost shows in the time.
  std::vector<Pass> with_walls(const std::string& kind) const {
    return {density("density_" + kind),
            force("force_" + kind, swe::LaxFriedrichsMuscl{1}),
            {"find_" + kind, none(), [w = w_] { w->find_walls(); }, o_n({})},
            {"reflect_" + kind, none(), [w = w_] { w->reflect(); }, o_n({})}};
  }

 private:
  static std::function<void()> none() {
    return [] {};
  }
  std::function<Work()> o_n(const Cost& cost) const {
    return [w = w_, cost] { return work_of(cost, w->size()); };
  }
  std::function<Work()> walk(const Cost& cost) const {
    return [w = w_, cost, pairs = w_->pairs(), listed = w_->listed()] {
      return work_of(cost, w->size(), pairs, listed, lanes);
    };
  }

  Pass sort() const {
    return {"sort", [w = w_] { w->stir(); }, [w = w_] { w->sort(); },
            [w = w_] {
              const double n = w->size();
              return add(add(add(work_of(extent_cost, n), work_of(count_cost, n)), work_of(place_cost, n)),
                         work_of(permute_cost, n), 10);
            }};
  }
  Pass list() const {
    return {"list", none(), [w = w_] { w->list(); }, walk(list_cost)};
  }

  Pass density(const std::string& name) const {
    const auto mean = std::make_shared<double>(1);
    return {name, [w = w_] { w->disturb_density(); }, [w = w_, mean] { *mean = w->density().newton_mean; },
            [first = walk(swe::density_gradient_cost), again = walk(swe::density_again_cost), mean] {
              Work work = first();
              work.flops += (*mean - 1) * again().flops;
              return work;
            }};
  }
  Pass force(const std::string& name, const swe::AnyStabilisation& s) const {
    return {name, none(), [w = w_, s] { w->force(s); }, walk(swe::internal_force_cost(s))};
  }

  std::shared_ptr<Water> w_;
};

}  // namespace freshet::perf
