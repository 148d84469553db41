#include "src/errors.hpp"
#include "src/fpm/solver.hpp"
#include "src/method.hpp"
#include "src/sisph/solver.hpp"
#include "src/swe/solver.hpp"

namespace freshet {

namespace {

template <template <int> class Solver>
std::unique_ptr<Method> in_dimension(const Scene& scene) {
  if (scene.domain.dimension == 1) return std::make_unique<Solver<1>>(scene);
  return std::make_unique<Solver<2>>(scene);
}

}  // namespace

std::unique_ptr<Method> make_method(const Scene& scene) {
  if (scene.method == "sph-swe") return in_dimension<swe::Solver>(scene);
  if (scene.method == "sisph") return in_dimension<sisph::Solver>(scene);
  if (scene.method == "fpm") return std::make_unique<fpm::Solver>(scene);
  throw SceneError("scene.method '" + scene.method + "' is none of: sph-swe, sisph, fpm");
}

}  // namespace freshet
