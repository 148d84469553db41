#include "src/run/stations.hpp"

#include <filesystem>

#include "cellgrid/on_device.hpp"

namespace freshet {
namespace {

double lerp(double a, double b, double w) { return a + w * (b - a); }

double interval(const Scene& scene) {
  return scene.output.gauges_every > 0 ? scene.output.gauges_every : scene.output.every;
}

PointState between(const PointState& a, const PointState& b, double w) {
  PointState state;
  state.bed = lerp(a.bed, b.bed, w);
  state.depth = lerp(a.reached ? a.depth : 0, b.reached ? b.depth : 0, w);
  state.reached = a.reached || b.reached;
  state.thin_is_dry = b.thin_is_dry;
  return state;
}

}  // namespace

GaugeRecorder::GaugeRecorder(const Scene& scene, const std::string& path)
    : gauges_(scene.gauges),
      folder_(std::filesystem::path(path).parent_path().string()),
      times_(regular_times(interval(scene), scene.end_time)),
      file_(path) {}

void GaugeRecorder::begin(const Method& method) {
  if (absent()) return;
  file_.create(gauges_);
  write_measured((std::filesystem::path(folder_) / "measured.csv").string(), gauges_);
  write(0, method.gauge(gauges_));
  times_.advance();
}

void GaugeRecorder::watch(const Method& method, double t, double until) {
  if (absent() || times_.next() > until || watched_t_ == t) return;
  watched_ = method.gauge(gauges_);
  watched_t_ = t;
}

void GaugeRecorder::record(const Method& method, double t) {
  if (absent() || !times_.due(t)) return;
  const auto now = method.gauge(gauges_);
  for (; times_.due(t); times_.advance()) {
    const double w = (times_.next() - watched_t_) / (t - watched_t_);
    std::vector<PointState> states;
    for (std::size_t g = 0; g < now.size(); ++g) states.push_back(between(watched_[g], now[g], w));
    write(times_.next(), states);
  }
  watched_ = now;
  watched_t_ = t;
}

void GaugeRecorder::write(double t, const std::vector<PointState>& states) {
  GaugeRow row;
  row.t = t;
  for (const auto& state : states) {
    const bool dry = !state.reached || (state.thin_is_dry && state.depth < dry_depth);
    row.elevation.push_back(dry ? state.bed : state.bed + state.depth);
    row.dry.push_back(dry);
  }
  file_.append(row);
  rows_.push_back(row);
}

void GaugeRecorder::save(Values& values) const { values["gauge_rows"] = {static_cast<double>(rows_.size())}; }

void GaugeRecorder::restore(const Values& values) {
  if (absent()) return;
  const auto rows = static_cast<std::size_t>(values.at("gauge_rows").at(0));
  rows_ = file_.continue_after(rows);
  times_.skip_to(rows);
}

RunUpRecorder::RunUpRecorder(const std::vector<RunUp>& points) {
  if (points.empty()) return;
  std::vector<ShorePlace> shores;
  for (const RunUp& point : points)
    shores.push_back({point.at[0], point.at[1], point.radius, point.min_depth});
  shores_.shore = on_device("run_up.shores", shores);
  shores_.highest = on_device("run_up.highest", std::vector<WetLevels>(points.size()));
}

void RunUpRecorder::record(const Method& method) {
  if (shores_.shore.extent(0) > 0) method.raise_wet_levels(shores_);
}

std::vector<WetLevels> RunUpRecorder::highest() const {
  const auto host = on_host(shores_.highest);
  return {host.data(), host.data() + host.extent(0)};
}

void RunUpRecorder::save(Values& values) const {
  std::vector<double>& all = values["run_up"];
  all.clear();
  for (const WetLevels& w : highest()) all.insert(all.end(), {w.bed, w.line});
}

void RunUpRecorder::restore(const Values& values) {
  const std::vector<double>& all = values.at("run_up");
  std::vector<WetLevels> highest;
  for (std::size_t k = 0; k < shores_.shore.extent(0); ++k) highest.push_back({all.at(2 * k), all.at(2 * k + 1)});
  if (!highest.empty()) shores_.highest = on_device("run_up.highest", highest);
}

}  // namespace freshet
