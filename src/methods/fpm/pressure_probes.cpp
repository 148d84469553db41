#include "src/methods/fpm/pressure_probes.hpp"

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/on_device.hpp"
#include "src/methods/fpm/nodes.hpp"

namespace freshet::fpm {
namespace {

constexpr double beyond = 0.5;      // x range of the values around: what is shown may lie so far outside it
constexpr double wet_within = 1.0;  // x dx: a place without a point so near is dry

}  // namespace

void PressureProbes::lay(const Scene& scene, const std::vector<Point>& places) {
  if (places == places_) return;
  places_ = places;
  std::vector<double> x, y, h, reach;
  for (const Point& at : places) {
    const double dx = spacing_at(scene, at);
    x.push_back(at[0]), y.push_back(at[1]);
    h.push_back(scene.fpm->support * dx), reach.push_back(wet_within * dx);
  }
  place_ = {on_device("fpm.gauge_x", x), on_device("fpm.gauge_y", y)};
  h_ = on_device("fpm.gauge_h", h), reach_ = on_device("fpm.gauge_reach", reach);
  slack_ = on_device("fpm.gauge_slack", std::vector<double>(x.size(), beyond));
  value_ = Field<double>("fpm.gauge_value", x.size());
  probe_ = Kokkos::View<Probe*, Memory>("fpm.gauge_probe", x.size());
}

std::vector<Probe> PressureProbes::look(const Scene& scene, const std::vector<Gauge>& gauges,
                                        const Near& around, const Field<double>& p) {
  std::vector<Point> places;
  for (const Gauge& g : gauges)
    if (g.what == Gauge::What::pressure) places.push_back(g.at);
  if (places.empty()) return {};
  lay(scene, places);
  const int count = static_cast<int>(places.size());
  transfer_.find(around, place_, h_, count);
  transfer_.apply(p, value_, slack_);
  const Near near = around;
  const VecField<double, 2> place = place_;
  const Field<double> reach = reach_, value = value_;
  const auto probe = probe_;
  launch(
      "fpm::gauge_wet", Range(0, count), KOKKOS_LAMBDA(int k) {
        int points = 0;
        near.for_each(at(place, k), reach(k), [&](int, const Vec<double, 2>&, double) { ++points; });
        probe(k) = {points > 0 ? value(k) : 0.0, points > 0};
      });
  const auto host = on_host(probe_);
  return {host.data(), host.data() + count};
}

}  // namespace freshet::fpm
