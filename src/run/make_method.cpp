#include "src/errors.hpp"
#include "src/fpm/solver.hpp"
#include "src/method.hpp"
#include "src/swe/solver.hpp"

namespace freshet {

std::unique_ptr<Method> make_method(const Scene& scene) {
  if (scene.method == "fpm") return std::make_unique<fpm::Solver>(scene);
  if (scene.method != "sph-swe") throw SceneError("scene.method '" + scene.method + "' is none of: sph-swe, fpm");
  if (scene.domain.dimension == 1) return std::make_unique<swe::Solver<1>>(scene);
  return std::make_unique<swe::Solver<2>>(scene);
}

}  // namespace freshet
