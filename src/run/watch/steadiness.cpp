#include "src/run/watch/steadiness.hpp"

#include <cmath>

#include "src/io/fluid.hpp"

namespace freshet {
namespace {

double largest_speed(const FieldSet& fields) {
  const Input<double> u = fields.real_or("u", "u"), v = fields.real_or("v", "u");
  const Input<int> kind = fields.integer_or_none("kind");  // boundary particles move as they are told
  const double second = fields.find_real("v") ? 1 : 0;
  const bool open = kind.extent(0) > 0;
  double most = 0;
  Kokkos::parallel_reduce(
      "run::largest_speed", Range(0, fields.size()),
      KOKKOS_LAMBDA(int i, double& most2) {
        const double speed2 = u(i) * u(i) + second * v(i) * v(i);
        if (!(open && kind(i) != 0) && speed2 > most2) most2 = speed2;
      },
      Kokkos::Max<double>(most));
  return std::sqrt(most);
}

}  // namespace

void SteadinessWatch::begin(const Method& method) {
  const FieldSet& fields = method.fields();
  for (const double depth : gather(fields.find_real("depth"), fluid_indices(fields)))
    deepest_ = std::max(deepest_, depth);
}

void SteadinessWatch::after_step(const Method& method, const Clock&) {
  fastest_ = std::max(fastest_, largest_speed(method.fields()));
}

Steadiness SteadinessWatch::result(const Method& method, const Clock& clock) const {
  const FieldSet& fields = method.fields();
  Steadiness steady;
  if (deepest_ > 0) {
    steady.max_speed_rel = fastest_ / std::sqrt(gravity_ * deepest_);
    steady.end_speed_rel = largest_speed(fields) / std::sqrt(gravity_ * deepest_);
  }
  if (!fields.has("depth_rate")) return steady;
  const auto rate = on_host(fields.real("depth_rate")), depth = on_host(fields.real("depth"));
  const bool open = fields.has("kind");
  const auto kind = on_host(open ? fields.integer("kind") : Field<int>());
  double sum = 0, count = 0;
  for (int i = 0; i < fields.size(); ++i) {
    if (open && kind(i) != 0) continue;
    sum += rate(i) * rate(i) / (depth(i) * depth(i));
    ++count;
  }
  if (count > 0) steady.rate = std::sqrt(sum / count);
  steady.thesis_ls = std::sqrt(sum) * clock.dt;
  return steady;
}

void SteadinessWatch::restore(const Values& values, const Clock&) {
  deepest_ = values.at("steady").at(0);
  fastest_ = values.at("steady").at(1);
}

void SteadinessWatch::report(const Method& method, const Clock& clock, Report& report) const {
  const Steadiness s = result(method, clock);
  report.object("steady")
      .value("max_speed_rel", s.max_speed_rel)
      .value("end_speed_rel", s.end_speed_rel)
      .value("rate", s.rate)
      .value("thesis_ls", s.thesis_ls)
      .end();
  report.tables += "largest speed " + scientific(s.max_speed_rel, 3) + " of sqrt(g d_max), at the end " +
                   scientific(s.end_speed_rel, 3) + "; depths change by " + scientific(s.rate, 2) +
                   " per second (rms), L_s of the thesis " + scientific(s.thesis_ls, 2) + '\n';
}

}  // namespace freshet
