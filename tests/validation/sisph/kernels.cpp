// SISPH with each kernel and each normalisation of slopes, on particles at rest and moving: the 2-D hump on
// disorder.
#include <catch2/catch.hpp>

#include <cmath>

#include "kernels/choice.hpp"
#include "kernels/smoothing/smoothing.hpp"
#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

using Keys = std::vector<std::string>;

double error(Keys keys, int n) {
  for (const std::string& key : {"water.spacing=" + std::to_string(2.0 / n),
                                 "time.dt=" + std::to_string(0.625 / n), std::string("sisph.theta=0.55")})
    keys.push_back(key);
  return test::run_case("sisph_bump", keys).errors.depth_l2_rel;
}

}  // namespace

TEST_CASE("sisph: every kernel converges, on particles at rest and moving", "[sisph][slow]") {
  // At l = 1.5 dx wider kernels smooth more: quintic and Gaussian (3 l) have a third more error than the
  // cubic spline (2 l).
  for (const KernelChoice& choice : alternatives<KernelChoice>())
    for (const char* formulation : {"at-rest", "moving"}) {
      const std::string kernel = name_of(choice);
      const Keys keys{"sisph.kernel=" + kernel, std::string("sisph.formulation=") + formulation,
                      "water.disorder=0.2"};
      const double coarse = error(keys, 50), fine = error(keys, 100);
      CAPTURE(kernel, formulation, coarse, fine);
      CHECK(coarse < 4.5e-3);
      CHECK(fine < 1.7e-3);
      CHECK(std::log2(coarse / fine) > 1.2);
    }
}

TEST_CASE("sisph: Shepard's sum alone normalises slopes as well on a lattice", "[sisph]") {
  for (const char* formulation : {"at-rest", "moving"}) {
    const std::string of = std::string("sisph.formulation=") + formulation;
    const double shepard = error({"sisph.correction=shepard", of}, 100), exact = error({of}, 100);
    CAPTURE(formulation, shepard, exact);
    CHECK(shepard < 1.3e-3);
    CHECK(shepard < 1.1 * exact);  // of (I4), against which it drops terms that a lattice cancels
  }
}
