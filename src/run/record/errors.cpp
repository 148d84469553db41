#include "src/run/record/errors.hpp"

#include <algorithm>
#include <chrono>

namespace freshet {
namespace {

// Every norm under its name in summary.json.
struct NormName {
  const char* key;
  double ErrorNorms::*value;
};
constexpr NormName norm_names[] = {
    {"depth_l1_rel", &ErrorNorms::depth_l1_rel},   {"depth_l2_rel", &ErrorNorms::depth_l2_rel},
    {"depth_linf", &ErrorNorms::depth_linf},       {"velocity_l2", &ErrorNorms::velocity_l2},
    {"grid_l2_rel", &ErrorNorms::grid_l2_rel},     {"depth_l2_mean_rel", &ErrorNorms::depth_l2_mean_rel},
    {"velocity_l2_x", &ErrorNorms::velocity_l2_x}, {"velocity_l2_y", &ErrorNorms::velocity_l2_y}};

// One row for each: the time, then the norms in the order of norm_names.
std::vector<double> flat(const std::vector<ErrorsAt>& rows) {
  std::vector<double> numbers;
  for (const ErrorsAt& row : rows) {
    numbers.push_back(row.t);
    for (const NormName& norm : norm_names) numbers.push_back(row.errors.*norm.value);
  }
  return numbers;
}

std::vector<ErrorsAt> errors_from(const std::vector<double>& numbers) {
  std::vector<ErrorsAt> rows;
  for (auto next = numbers.begin(); next != numbers.end();) {
    ErrorsAt& row = rows.emplace_back(ErrorsAt{*next++, {}});
    for (const NormName& norm : norm_names) row.errors.*norm.value = *next++;
  }
  return rows;
}

void write_json(JsonWriter& out, const ErrorNorms& errors) {
  for (const NormName& norm : norm_names) out.value(norm.key, errors.*norm.value);
  out.end();
}

std::string line(const ErrorNorms& e) {
  const auto s = [](double value) { return scientific(value, 3); };
  return "\nagainst the exact solution: depth l2 " + s(e.depth_l2_rel) + ", l1 " + s(e.depth_l1_rel) +
         ", on a grid l2 " + s(e.grid_l2_rel) + ", max " + s(e.depth_linf) + " m; velocity rms " +
         s(e.velocity_l2) + " m/s\n";
}

std::string table(const std::vector<ErrorsAt>& errors_at) {
  const auto row = [](const std::string& time, const std::array<std::string, 4>& c) {
    return formatted("%10s %12s %12s %12s %12s\n", time.c_str(), c[0].c_str(), c[1].c_str(), c[2].c_str(),
                     c[3].c_str());
  };
  std::string lines = '\n' + row("time", {"depth l2", "(2.58)", "vx (2.59)", "vy (2.59)"}) + row("[s]", {});
  const auto s = [](double value) { return scientific(value, 3); };
  for (const auto& [t, e] : errors_at)
    lines +=
        row(brief(t, 4), {s(e.depth_l2_rel), s(e.depth_l2_mean_rel), s(e.velocity_l2_x), s(e.velocity_l2_y)});
  return lines;
}

std::vector<double> take_times(const Scene& scene) {
  std::vector<double> times = comparison_times(scene.compare, scene.end_time);
  times.insert(times.end(), scene.compare.times.begin(), scene.compare.times.end());
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

std::vector<double> comparison_times(const Compare& compare, double end) {
  std::vector<double> times;
  const int intervals = std::max(compare.samples - 1, 1);
  for (int k = std::max(compare.samples - 1, 0); k >= 0; --k)
    times.push_back(end - compare.window * k / intervals);
  times.erase(times.begin(), std::find_if(times.begin(), times.end(), [](double t) { return t >= 0; }));
  return times;
}

ErrorRecorder::ErrorRecorder(const Scene& scene)
    : Observer(take_times(scene)), scene_(scene),
      comparisons_(comparison_times(scene.compare, scene.end_time)) {}

void ErrorRecorder::take(const Method& method, const Clock& clock) {
  const auto begun = std::chrono::steady_clock::now();
  for (const double t : comparisons_)
    if (t == clock.t) l1_samples_.push_back(depth_l1(scene_, fluid_on_host(method.fields()), t));
  for (const double t : scene_.compare.times)
    if (t == clock.t) errors_at_.push_back({t, errors(method, t)});
  comparing_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

ErrorNorms ErrorRecorder::errors(const Method& method, double t) const {
  ErrorNorms errors = error_norms(scene_, fluid_on_host(method.fields()), t);
  errors.grid_l2_rel = grid_l2(scene_, method, t);
  return errors;
}

ErrorNorms ErrorRecorder::at_end(const Method& method, const Clock& clock) const {
  ErrorNorms end = errors(method, clock.t);
  end.depth_l1_rel = median(l1_samples_);
  return end;
}

void ErrorRecorder::save(Values& values) const {
  values["depth_l1_rel"] = l1_samples_;
  values["errors_at"] = flat(errors_at_);
}

void ErrorRecorder::restore(const Values& values, const Clock&) {
  l1_samples_ = values.at("depth_l1_rel");
  errors_at_ = errors_from(values.at("errors_at"));
}

void ErrorRecorder::report(const Method& method, const Clock& clock, Report& report) const {
  const ErrorNorms end = at_end(method, clock);
  write_json(report.object("errors"), end);
  report.tables += line(end);
  if (errors_at_.empty()) return;
  JsonWriter& out = report.array("errors_at");
  for (const auto& [t, errors] : errors_at_) write_json(out.begin().value("t", t), errors);
  out.end_array();
  report.tables += table(errors_at_);
}

}  // namespace freshet
