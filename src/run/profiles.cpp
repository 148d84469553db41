#include "src/run/profiles.hpp"

#include <algorithm>
#include <cmath>

#include "src/io/files.hpp"
#include "src/io/number.hpp"
#include "src/run/stations.hpp"

namespace freshet {
namespace {

struct Span {
  double first, last;  // m, places of the line's ends
};
Span span(const Transect& p) {
  const double length = std::hypot(p.line[1][0] - p.line[0][0], p.line[1][1] - p.line[0][1]);
  return p.one_dimensional ? Span{std::min(p.line[0][0], p.line[1][0]), std::max(p.line[0][0], p.line[1][0])} : Span{0, length};
}

// The places of the measured points that lie on the line.
std::vector<std::size_t> measured_on_line(const Transect& p) {
  std::vector<std::size_t> found;
  const Span on = span(p);
  for (std::size_t k = 0; p.measured && k < p.measured->t.size(); ++k)
    if (p.measured->t[k] >= on.first && p.measured->t[k] <= on.last) found.push_back(k);
  return found;
}

}  // namespace

std::vector<double> profile_times(const Scene& scene) {
  std::vector<double> times;
  for (const Transect& profile : scene.profiles) times.push_back(profile.time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

ProfileRecorder::ProfileRecorder(const Scene& scene, std::string path)
    : profiles_(scene.profiles), taken_(scene.profiles.size()), path_(std::move(path)) {}

std::vector<double> ProfileRecorder::places(const Transect& profile) const {
  const Span on = span(profile);
  const int intervals = std::max(1, static_cast<int>(std::lround((on.last - on.first) / profile.spacing)));
  std::vector<double> places;
  for (int k = 0; k <= intervals; ++k) places.push_back(on.first + (on.last - on.first) * k / intervals);
  for (const std::size_t k : measured_on_line(profile)) places.push_back(profile.measured->t[k]);
  return places;
}

void ProfileRecorder::record(const Method& method, double t) {
  for (std::size_t k = 0; k < profiles_.size(); ++k) {
    if (profiles_[k].time != t) continue;
    std::vector<Point> points;
    for (const double place : places(profiles_[k])) points.push_back(profiles_[k].at(place));
    taken_[k] = {};
    for (const PointState& state : method.sample(points)) {
      const double depth = state.reached && state.depth >= dry_depth ? state.depth : 0;
      taken_[k].depth.push_back(depth);
      taken_[k].elevation.push_back(state.bed + depth);
    }
  }
  write();
}

std::vector<ProfileResult> ProfileRecorder::results() const {
  std::vector<ProfileResult> results;
  for (std::size_t k = 0; k < profiles_.size(); ++k) {
    results.push_back({profiles_[k].name, profiles_[k].time});
    const std::vector<std::size_t> measured = measured_on_line(profiles_[k]);
    if (taken_[k].elevation.empty() || measured.empty()) continue;
    const std::size_t first = taken_[k].elevation.size() - measured.size();
    double sum = 0, largest = 0, low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const double wanted = profiles_[k].measured->value[measured[i]], difference = taken_[k].elevation[first + i] - wanted;
      sum += difference * difference;
      largest = std::max(largest, std::abs(difference));
      low = std::min(low, wanted);
      high = std::max(high, wanted);
    }
    ProfileResult& result = results.back();
    result.rmse = std::sqrt(sum / static_cast<double>(measured.size()));
    result.max_abs_error = largest;
    result.measured_range = high - low;
    result.points = static_cast<int>(measured.size());
  }
  return results;
}

void ProfileRecorder::write() const {
  std::string text = "profile,t [s],place [m],elevation [m],depth [m],measured [m]\n";
  for (std::size_t k = 0; k < profiles_.size(); ++k) {
    if (taken_[k].elevation.empty()) continue;
    const std::vector<double> at = places(profiles_[k]);
    const std::vector<std::size_t> measured = measured_on_line(profiles_[k]);
    for (std::size_t i = 0; i < at.size(); ++i) {
      text += csv_word(profiles_[k].name) + ',' + shortest(profiles_[k].time) + ',' + shortest(at[i]) + ',' +
              shortest(taken_[k].elevation[i]) + ',' + shortest(taken_[k].depth[i]) + ',';
      const std::size_t regular = at.size() - measured.size();
      if (i >= regular) text += shortest(profiles_[k].measured->value[measured[i - regular]]);
      text += '\n';
    }
  }
  write_text(path_, text);
}

void ProfileRecorder::save(Values& values) const {
  for (std::size_t k = 0; k < taken_.size(); ++k) {
    values["profile." + std::to_string(k) + ".elevation"] = taken_[k].elevation;
    values["profile." + std::to_string(k) + ".depth"] = taken_[k].depth;
  }
}

void ProfileRecorder::restore(const Values& values) {
  for (std::size_t k = 0; k < taken_.size(); ++k)
    taken_[k] = {values.at("profile." + std::to_string(k) + ".elevation"), values.at("profile." + std::to_string(k) + ".depth")};
}

}  // namespace freshet
