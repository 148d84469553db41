#include "src/run/watch/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cellgrid/particles/clusters.hpp"
#include "src/errors.hpp"
#include "src/io/fluid.hpp"

namespace freshet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// a few smoothing lengths: walls act within 2 h, so a particle beyond is lost
constexpr double margin_in_h = 4;
// depth of an open boundary's buffer outside the domain, or where particles are longer
constexpr double buffer_in_dx = 6;
constexpr double buffer_in_h = 2.5;  // than the first, in their h

Allowed allowed_in(const Scene& scene) {
  const double dx = scene.water.spacing;
  const double near = margin_in_h * scene.sph.eta * dx;
  double margin = near;
  for (const OpenBoundary& b : scene.boundaries) {
    const double spacing = std::max(dx, b.spacing), longest = scene.sph.h_cap * scene.sph.eta * spacing;
    margin = std::max({margin, near + buffer_in_dx * spacing, buffer_in_h * longest + spacing});
  }
  // Water without walls that moves as it is goes on for good.
  if (scene.method == "sisph" && scene.sisph.moving && scene.walls.empty()) margin = infinity;
  const Point low = scene.domain.low, high = scene.domain.high;
  const bool flat = scene.domain.dimension == 1;
  return {low[0] - margin,
          high[0] + margin,
          flat ? -infinity : low[1] - margin,
          flat ? infinity : high[1] + margin,
          margin,
          scene.limits.speed};
}

std::string when(const Clock& clock) {
  return "at t = " + brief(clock.t) + " s, step " + std::to_string(clock.step);
}

// Every comparison is false for NaN, so that "not (inside)" also finds values that are not finite.
int count_bad(const FieldSet& fields, const Allowed& in) {
  const Field<double> x = fields.real_or("x", "x"), y = fields.real_or("y", "x");
  const Field<double> u = fields.real_or("u", "u"), v = fields.real_or("v", "u");
  const Field<double> depth = fields.real_or("depth", "x");
  const double least = fields.find_real("depth") ? -std::numeric_limits<double>::min() : -infinity;
  const double limit2 = in.speed * in.speed, second = fields.find_real("v") ? 1 : 0;
  const int n = fields.size();
  int bad = 0;
  Kokkos::parallel_reduce(
      "run::monitor", Range(0, blocks(n)),
      KOKKOS_LAMBDA(int b, int& count_of_bad) {
        const Lanes me = block(b, n);
        const Lane px = me.load(x), py = me.load(y), vx = me.load(u), vy = me.load(v), d = me.load(depth);
        const auto inside =
            (Lane(in.x_low) < px) & (px < Lane(in.x_high)) & (Lane(in.y_low) < py) & (py < Lane(in.y_high));
        const auto sound =
            (Lane(least) < d) & (d < Lane(infinity)) & (vx * vx + second * (vy * vy) < Lane(limit2));
        count_of_bad += me.count - count(first_lanes(me.count) & inside & sound);
      },
      bad);
  return bad;
}

// The fields of a launch: a fixed number fits its arguments.
struct FieldGroup {
  static constexpr int most = 32;
  Kokkos::Array<const double*, most> data;
  int count = 0;
};

int count_not_finite(const FieldGroup& group, int n) {
  int bad = 0;
  Kokkos::parallel_reduce(
      "run::monitor_all", Range(0, blocks(n)),
      KOKKOS_LAMBDA(int b, int& count_of_bad) {
        const Lanes me = block(b, n);
        for (int f = 0; f < group.count; ++f)
          for (int i = me.first; i < me.first + me.count; ++i) {
            const double value = group.data[f][i];
            count_of_bad += !(-infinity < value && value < infinity);
          }
      },
      bad);
  return bad;
}

// Of every field but scratch (Carry::no), which belongs to no particle and may hold anything.
int count_not_finite(const FieldSet& fields) {
  int bad = 0;
  FieldGroup group;
  for (const auto& field : fields.reals()) {
    if (field.carry == Carry::no) continue;
    group.data[group.count++] = field.data.data();
    if (group.count < FieldGroup::most) continue;
    bad += count_not_finite(group, fields.size());
    group.count = 0;
  }
  return group.count > 0 ? bad + count_not_finite(group, fields.size()) : bad;
}

// The particles on the host, where something is wrong. A field that the method does not have reads as zero.
class HostParticles {
 public:
  explicit HostParticles(const FieldSet& fields) : fields_(fields) {
    for (const auto& field : fields.reals()) host_.push_back(on_host(field.data));
    if (const auto* id = fields.find_integer("id")) id_ = on_host(id->data);
    x_ = host("x"), y_ = host("y"), u_ = host("u"), v_ = host("v"), depth_ = host("depth");
  }

  int id(int i) const { return id_.extent(0) ? id_(i) : i; }
  std::string where(int i) const {
    const std::string place = "particle " + std::to_string(id(i)) + " at x = " + brief(x_(i), 9) + " m";
    return y_.extent(0) ? place + ", y = " + brief(y_(i), 9) + " m" : place;
  }

  // What is wrong with particle i, and the limit; "" if nothing is.
  std::string fault(int i, const Allowed& in) const {
    const double v = v_.extent(0) ? v_(i) : 0, y = y_.extent(0) ? y_(i) : in.y_low,
                 speed = std::hypot(u_(i), v);
    if (const std::string value = not_finite(i); !value.empty())
      return value + "; limit: every value is finite";
    if (depth_.extent(0) && depth_(i) < 0)
      return "depth = " + brief(depth_(i)) + " m; limit: no depth is negative";
    if (speed > in.speed) {
      return "speed = " + brief(speed) + " m/s; limit: limits.speed = " + brief(in.speed) + " m/s";
    }
    if (x_(i) >= in.x_low && x_(i) <= in.x_high && y >= in.y_low && y <= in.y_high) return "";
    return "it left the domain; limit: " + brief(in.margin) + " m outside";
  }

 private:
  using Host = decltype(on_host(Field<double>()));

  Host host(const char* name) const {
    const auto* field = fields_.find_real(name);
    return field ? on_host(field->data) : Host();
  }

  std::string not_finite(int i) const {
    for (std::size_t f = 0; f < host_.size(); ++f) {
      const auto& field = fields_.reals()[f];
      if (field.carry != Carry::no && !std::isfinite(host_[f](i)))
        return field.name + " = " + brief(host_[f](i));
    }
    return "";
  }

  const FieldSet& fields_;
  std::vector<Host> host_;
  Host x_, y_, u_, v_, depth_;
  decltype(on_host(Field<int>())) id_;
};

// Of several the particle with the lowest id, whatever the order in memory; "" if nothing is wrong.
std::string find_bad(const FieldSet& fields, const Allowed& allowed) {
  const HostParticles particles(fields);
  int first = -1;
  std::string found;
  for (int i = 0; i < fields.size(); ++i) {
    const std::string fault = particles.fault(i, allowed);
    if (fault.empty() || (first >= 0 && particles.id(first) <= particles.id(i))) continue;
    first = i;
    found = particles.where(i) + ": " + fault;
  }
  return found;
}

}  // namespace

double mass_error(double initial, const Totals& totals) {
  const double scale = std::max(initial > 0 ? initial : totals.inflow, 1e-300);
  return std::abs(totals.mass - initial - totals.inflow + totals.outflow) / scale;
}

Monitor::Monitor(const Scene& scene)
    : Observer(regular_times(scene.output.every, scene.end_time)), allowed_(allowed_in(scene)),
      mass_limit_(scene.limits.mass_error), open_(!scene.boundaries.empty()) {}

void Monitor::begin(const Method& method) {
  initial_mass_ = method.totals().mass;
  initial_particles_ = fluid_count(method.fields());
}

void Monitor::after_step(const Method& method, const Clock& clock) {
  const TimedRegion region("run::check");
  check(method, clock);
  if (clock.step % 100 == 0) look(method, clock);
}

void Monitor::check(const Method& method, const Clock& clock) const {
  if (count_bad(method.fields(), allowed_) == 0) return;
  throw Diverged("the run diverged " + when(clock) + ": " + find_bad(method.fields(), allowed_));
}

void Monitor::look(const Method& method, const Clock& clock) {
  if (clock.step == looked_at_) return;
  check_all(method, clock);
  looked_at_ = clock.step;
}

void Monitor::check_all(const Method& method, const Clock& clock) const {
  const FieldSet& fields = method.fields();
  const bool sound = count_bad(fields, allowed_) == 0 && count_not_finite(fields) == 0;
  const std::string bad = sound ? "" : find_bad(fields, allowed_);
  if (!bad.empty()) throw Diverged("the run diverged " + when(clock) + ": " + bad);
  const Totals totals = method.totals();
  const double error = mass_error(initial_mass_, totals);
  if (error <= mass_limit_) return;
  throw Diverged("the mass balance broke " + when(clock) + ": " + brief(totals.mass) + " m3 of water, " +
                 brief(initial_mass_) + " m3 at the start, " + brief(totals.inflow) + " m3 in, " +
                 brief(totals.outflow) + " m3 out: relative error " + brief(error) +
                 "; limit: limits.mass_error = " + brief(mass_limit_));
}

void Monitor::check_dt(double dt, const Clock& clock) {
  if (dt > 0 && clock.t + dt > clock.t) return;
  throw Diverged("the run diverged " + when(clock) + ": the stable time step is " + brief(dt) +
                 " s; limit: time must advance");
}

MassBalance Monitor::balance(const Totals& totals) const {
  MassBalance mass{initial_mass_, totals.inflow, totals.outflow, totals.mass,
                   mass_error(initial_mass_, totals)};
  const double unaccounted = std::abs(totals.inflow - totals.outflow - totals.straddle - totals.flux);
  if (open_) mass.flux_error = unaccounted / std::max(totals.flux_gross, 1e-300);
  return mass;
}

void Monitor::save(Values& values) const {
  values["initial"] = {initial_mass_, static_cast<double>(initial_particles_)};
}

void Monitor::restore(const Values& values, const Clock&) {
  initial_mass_ = values.at("initial").at(0);
  initial_particles_ = static_cast<int>(values.at("initial").at(1));
}

void Monitor::report(const Method& method, const Clock&, Report& report) const {
  const MassBalance mass = balance(method.totals());
  report.object("mass")
      .value("initial_m3", mass.initial)
      .value("inflow_m3", mass.inflow)
      .value("outflow_m3", mass.outflow)
      .value("final_m3", mass.final)
      .value("relative_error", mass.relative_error)
      .value("flux_error", mass.flux_error)
      .end();
  report.balance += formatted("mass: relative error %.1e", mass.relative_error);
  if (std::isfinite(mass.flux_error)) report.balance += formatted(", flux error %.2e", mass.flux_error);
  report.balance += '\n';
}

}  // namespace freshet
