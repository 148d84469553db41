#include "src/run/steady.hpp"

#include <cmath>

#include "src/io/fluid.hpp"

namespace freshet {
namespace {

Input<double> field_or(const FieldSet& fields, const char* name, const char* fallback) {
  const auto* field = fields.find_real(name);
  return field ? field->data : fields.find_real(fallback)->data;
}

// Boundary particles move as they are told.
Input<int> kinds(const FieldSet& fields) {
  return fields.integer_or_none("kind");
}

double largest_speed(const FieldSet& fields) {
  const Input<double> u = field_or(fields, "u", "u"), v = field_or(fields, "v", "u");
  const Input<int> kind = kinds(fields);
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

void SteadyRecorder::begin(const Method& method) {
  if (!wanted_) return;
  for (const double depth : fluid_on_host(method.fields()).depth) deepest_ = std::max(deepest_, depth);
}

void SteadyRecorder::record(const Method& method) {
  if (wanted_) fastest_ = std::max(fastest_, largest_speed(method.fields()));
}

Steadiness SteadyRecorder::result(const Method& method, double dt) const {
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
  steady.thesis_ls = std::sqrt(sum) * dt;
  return steady;
}

void SteadyRecorder::restore(const Values& values) {
  deepest_ = values.at("steady").at(0);
  fastest_ = values.at("steady").at(1);
}

}  // namespace freshet
