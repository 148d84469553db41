// Where rows are cut into clusters changes no bit of what a particle gets: lanes do not see each other, and
// who is listed for another lane's sake adds nothing. (In single precision two neighbours are summed at once:
// which two hangs on the list.)
#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;

namespace {

constexpr double dx = 0.1;

template <int D>
std::vector<std::vector<double>> results(int later, const swe::AnyStabilisation& stabilise, bool walled) {
  std::vector<test::Grain> water = test::random_water(D, D == 2 ? 900 : 90, dx, 5);
  water.push_back(water.front());
  water.back().x = {0, D == 2 ? 60 * dx : 0.0};  // empty rows lie before it
  Cloud<D> cloud(water, dx);
  cloud.cut_later = later;
  const double side = D == 2 ? 1.5 : 4.5;  // half of what random_water fills
  if (walled && D == 2)
    cloud.add_walls({{{-side, -side}, {side, -side}, {side, side}, {-side, side}, {-side, -side}}}, {0, 0});
  auto options = test::tight(D);
  options.gradient = true;
  cloud.settle(options);
  cloud.force(stabilise);
  std::vector<std::vector<double>> all;
  for (const char* name :
       {"depth", "h", "depth_rate", "strain_xx", "pressure", "depth_slope_x", "tx", "signal"})
    all.push_back(cloud.by_id(name));
  return all;
}

template <int D>
void check_cuts(const swe::AnyStabilisation& stabilise, bool walled) {
  const auto expected = results<D>(0, stabilise, walled);
  CHECK(test::largest_size(expected[0]) > 0);
  for (int later = 1; later < lanes; ++later) {
    CAPTURE(D, later, walled);
    const auto found = results<D>(later, stabilise, walled);
    for (std::size_t k = 0; k < found.size(); ++k) CHECK((found[k] == expected[k]));
  }
}

}  // namespace

TEST_CASE("cuts: clusters cut k lanes later give the same bits") {
  const swe::AnyStabilisation muscl = swe::LaxFriedrichsMuscl{1}, viscous = swe::ArtificialViscosity{0.5, 0};
  check_cuts<2>(muscl, false);
  check_cuts<2>(viscous, true);
  check_cuts<1>(muscl, false);
}
