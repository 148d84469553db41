// An incompressible flow that is put away and taken up again goes on to the bit.
#include <catch2/catch.hpp>

#include <cstring>

#include "tests/support/run/flow.hpp"

using namespace freshet;

namespace {

using Words = std::vector<std::string>;
const Words small{"water.spacing=0.0057", "time.end=0.18", "output.every=0.18"};
const Words every_feature{"water.spacing=0.004",    "fpm.grading=1 + 8*x", "fluid.viscosity=1e-3",
                          "fpm.diffusion=implicit", "time.end=0.18",       "output.every=0.18"};

void advance(fpm::FinitePointset& solver, int steps) {
  for (int k = 0; k < steps; ++k) solver.step(0, solver.stable_dt());
}

template <class Named>
void copy_saved(const Named& from, const Named& to, int n) {
  for (std::size_t f = 0; f < from.size(); ++f)
    if (is_saved(from[f].carry))
      std::memcpy(to[f].data.data(), from[f].data.data(),
                  sizeof(from[f].data(0)) * static_cast<std::size_t>(n));
}

// A solver that knows of the other only what a checkpoint holds.
void take_up(const fpm::FinitePointset& from, fpm::FinitePointset& to) {
  const int n = from.fields().size();
  to.fields().resize(n);
  copy_saved(from.fields().reals(), to.fields().reals(), n);
  copy_saved(from.fields().integers(), to.fields().integers(), n);
  to.restore(from.scalars());
}

template <class Named>
bool same_saved(const Named& a, const Named& b, int n) {
  for (std::size_t f = 0; f < a.size(); ++f)
    if (is_saved(a[f].carry) && std::memcmp(a[f].data.data(), b[f].data.data(),
                                            sizeof(a[f].data(0)) * static_cast<std::size_t>(n)) != 0)
      return false;
  return true;
}

}  // namespace

TEST_CASE("A collapsing column goes on to the bit from what a checkpoint holds") {
  const Words& overrides = GENERATE(0, 1) ? every_feature : small;
  test::FlowRun straight("fpm_martin_moyce", overrides), first("fpm_martin_moyce", overrides),
      second("fpm_martin_moyce", overrides);
  advance(straight.solver, 24);
  advance(first.solver, 11);
  take_up(first.solver, second.solver);
  advance(second.solver, 13);
  const FieldSet &a = straight.solver.fields(), &b = second.solver.fields();
  REQUIRE(a.size() == b.size());
  CHECK(same_saved(a.reals(), b.reals(), a.size()));
  CHECK(same_saved(a.integers(), b.integers(), a.size()));
  CHECK((straight.solver.scalars() == second.solver.scalars()));
}
