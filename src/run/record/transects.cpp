#include "src/run/record/transects.hpp"

#include <algorithm>
#include <cmath>

#include "src/io/files.hpp"
#include "src/run/record/gauges.hpp"

namespace freshet {
namespace {

struct LineSpan {
  double first, last;  // m, places of the line's ends
};
LineSpan span(const Transect& p) {
  const double length = std::hypot(p.line[1][0] - p.line[0][0], p.line[1][1] - p.line[0][1]);
  return p.one_dimensional
             ? LineSpan{std::min(p.line[0][0], p.line[1][0]), std::max(p.line[0][0], p.line[1][0])}
             : LineSpan{0, length};
}

// The places of the measured points that lie on the line.
std::vector<std::size_t> measured_on_line(const Transect& p) {
  std::vector<std::size_t> found;
  const LineSpan on = span(p);
  for (std::size_t k = 0; p.measured && k < p.measured->t.size(); ++k)
    if (p.measured->t[k] >= on.first && p.measured->t[k] <= on.last) found.push_back(k);
  return found;
}

// m, the points that are written, then the measured ones on the line.
std::vector<double> places(const Transect& p) {
  const LineSpan on = span(p);
  const int intervals = std::max(1, static_cast<int>(std::lround((on.last - on.first) / p.spacing)));
  std::vector<double> places;
  for (int k = 0; k <= intervals; ++k) places.push_back(on.first + (on.last - on.first) * k / intervals);
  for (const std::size_t k : measured_on_line(p)) places.push_back(p.measured->t[k]);
  return places;
}

// Increasing, each time once.
std::vector<double> times_of(const std::vector<Transect>& transects) {
  std::vector<double> times;
  for (const Transect& transect : transects) times.push_back(transect.time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

// elevation: at places().
void compare_with_measured(const Transect& transect, const std::vector<double>& elevation,
                           TransectResult& result) {
  const std::vector<std::size_t> measured = measured_on_line(transect);
  if (elevation.empty() || measured.empty()) return;
  const std::size_t first = elevation.size() - measured.size();
  double sum = 0, largest = 0, low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double wanted = transect.measured->value[measured[i]], difference = elevation[first + i] - wanted;
    sum += difference * difference;
    largest = std::max(largest, std::abs(difference));
    low = std::min(low, wanted);
    high = std::max(high, wanted);
  }
  result.rmse = std::sqrt(sum / static_cast<double>(measured.size()));
  result.max_abs_error = largest;
  result.measured_range = high - low;
  result.points = static_cast<int>(measured.size());
}

}  // namespace

TransectRecorder::TransectRecorder(const Scene& scene, const std::string& directory)
    : Observer(times_of(scene.profiles)), transects_(scene.profiles), taken_(scene.profiles.size()),
      path_(path_in(directory, "profiles.csv")) {}

void TransectRecorder::take(const Method& method, const Clock& clock) {
  for (std::size_t k = 0; k < transects_.size(); ++k) {
    if (transects_[k].time != clock.t) continue;
    std::vector<Point> points;
    for (const double place : places(transects_[k])) points.push_back(transects_[k].at(place));
    taken_[k] = {};
    for (const PointState& state : method.sample(points)) {
      const double depth = state.reached && state.depth >= dry_depth ? state.depth : 0;
      taken_[k].depth.push_back(depth);
      taken_[k].elevation.push_back(state.bed + depth);
    }
  }
  write();
}

void TransectRecorder::write() const {
  std::string text = "profile,t [s],place [m],elevation [m],depth [m],measured [m]\n";
  for (std::size_t k = 0; k < transects_.size(); ++k) {
    if (taken_[k].elevation.empty()) continue;
    const std::vector<double> at = places(transects_[k]);
    const std::vector<std::size_t> measured = measured_on_line(transects_[k]);
    const std::size_t regular = at.size() - measured.size();
    for (std::size_t i = 0; i < at.size(); ++i) {
      text += csv_word(transects_[k].name);
      for (const double value : {transects_[k].time, at[i], taken_[k].elevation[i], taken_[k].depth[i]})
        text += ',' + shortest(value);
      text += ',';
      if (i >= regular) text += shortest(transects_[k].measured->value[measured[i - regular]]);
      text += '\n';
    }
  }
  write_text(path_, text);
}

void TransectRecorder::save(Values& values) const {
  for (std::size_t k = 0; k < taken_.size(); ++k) {
    values["profile." + std::to_string(k) + ".elevation"] = taken_[k].elevation;
    values["profile." + std::to_string(k) + ".depth"] = taken_[k].depth;
  }
}

void TransectRecorder::restore(const Values& values, const Clock&) {
  for (std::size_t k = 0; k < taken_.size(); ++k) {
    const std::string name = "profile." + std::to_string(k);
    taken_[k] = {values.at(name + ".elevation"), values.at(name + ".depth")};
  }
}

std::vector<TransectResult> TransectRecorder::results() const {
  std::vector<TransectResult> results;
  for (std::size_t k = 0; k < transects_.size(); ++k) {
    results.push_back({transects_[k].name, transects_[k].time});
    compare_with_measured(transects_[k], taken_[k].elevation, results.back());
  }
  return results;
}

void TransectRecorder::report(const Method&, const Clock&, Report& report) const {
  JsonWriter& out = report.object("profiles");
  report.tables +=
      formatted("\n%-12s %8s %8s %8s %12s %7s\n", "profile", "at [s]", "rmse", "max", "range [mm]", "points");
  for (const TransectResult& r : results()) {
    out.begin(r.name)
        .value("time", r.time)
        .value("rmse", r.rmse)
        .value("max_abs_error", r.max_abs_error)
        .value("measured_range", r.measured_range)
        .value("points", r.points)
        .end();
    const auto mm = [](double m) { return decimal(m, 1e-3, 2); };
    report.tables +=
        formatted("%-12s %8s %8s %8s %12s %7d\n", r.name.c_str(), decimal(r.time, 1, 2).c_str(),
                  mm(r.rmse).c_str(), mm(r.max_abs_error).c_str(), mm(r.measured_range).c_str(), r.points);
  }
  out.end();
}

}  // namespace freshet
