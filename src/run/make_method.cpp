#include "src/errors.hpp"
#include "src/methods/fpm/solver.hpp"
#include "src/methods/method.hpp"
#include "src/methods/sisph/at_rest.hpp"
#include "src/methods/sisph/moving.hpp"
#include "src/methods/swe/relax.hpp"
#include "src/methods/swe/solver.hpp"

namespace freshet {
namespace {

template <int D>
std::unique_ptr<Method> make_shallow(const Scene& scene) {
  if (scene.method == "sph-swe" && scene.water.start == Water::Start::relaxed)
    return std::make_unique<swe::ExplicitSph<D>>(scene, swe::relaxed_lattice<D>(scene));
  if (scene.method == "sph-swe") return std::make_unique<swe::ExplicitSph<D>>(scene);
  if (scene.sisph.moving) return std::make_unique<sisph::LagrangianSph<D>>(scene);
  return std::make_unique<sisph::EulerianSph<D>>(scene);
}

}  // namespace

std::unique_ptr<Method> make_method(const Scene& scene) {
  if (scene.method == "fpm") return std::make_unique<fpm::FinitePointset>(scene);
  if (scene.method != "sph-swe" && scene.method != "sisph")
    throw SceneError("scene.method '" + scene.method + "' is none of: sph-swe, sisph, fpm");
  return scene.domain.dimension == 1 ? make_shallow<1>(scene) : make_shallow<2>(scene);
}

}  // namespace freshet
