#include "src/scene/open_law.hpp"

#include "cellgrid/on_device.hpp"

namespace freshet {
namespace {

TimeSeries in_time(const Series& series) {
  if (series.t.empty()) return {};
  return {on_device("open.times", series.t), on_device("open.values", series.value)};
}

}  // namespace

std::function<OpenLaw(double)> law_of(const OpenBoundary& b) {
  using Kind = OpenBoundary::Kind;
  switch (b.kind) {
    case Kind::elevation: return [level = b.level](double t) { return ImposedLevel{level.at(t)}; };
    case Kind::wave: return [level = b.level](double t) { return IncomingWave{level.at(t)}; };
    case Kind::velocity: return [velocity = b.velocity](double t) { return ImposedVelocity{velocity.at(t)}; };
    case Kind::discharge:
      return [total = b.discharge, by_width = b.by_width](double t) { return ImposedDischarge{total.at(t), by_width}; };
    case Kind::state:
      return [b](double t) {
        const bool by_depth = !b.depth.t.empty();
        return ImposedState{by_depth ? b.depth.at(t) : b.level.at(t), by_depth, b.velocity.at(t)};
      };
    case Kind::transmissive: break;
  }
  if (b.level.t.empty()) return [](double) { return Transmissive{}; };
  return [level = b.level](double t) { return ImposedState{level.at(t), false}; };
}

LawInTime law_in_time(const OpenBoundary& b) {
  using Kind = OpenBoundary::Kind;
  const OpenLaw law = law_of(b)(0);
  switch (b.kind) {
    case Kind::elevation:
    case Kind::wave:
    case Kind::transmissive: return {law, in_time(b.level), {}};
    case Kind::velocity: return {law, in_time(b.velocity), {}};
    case Kind::discharge: return {law, in_time(b.discharge), {}};
    case Kind::state: break;
  }
  return {law, in_time(b.depth.t.empty() ? b.level : b.depth), in_time(b.velocity)};
}

}  // namespace freshet
