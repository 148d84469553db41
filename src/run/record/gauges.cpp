#include "src/run/record/gauges.hpp"

#include "src/io/files.hpp"

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

void write_json(JsonWriter& out, const GaugeResult& gauge) {
  out.begin(gauge.name)
      .value("rmse", gauge.rmse).value("rmse_window", gauge.rmse_window)
      .value("window_start", gauge.window.first).value("window_end", gauge.window.second)
      .value("max_abs_error", gauge.max_abs_error)
      .value("peak", gauge.peak).value("peak_time", gauge.peak_time)
      .value("measured_peak", gauge.measured_peak).value("measured_peak_time", gauge.measured_peak_time)
      .value("arrival", gauge.arrival).value("measured_arrival", gauge.measured_arrival)
      .value("dry_fraction", gauge.dry)
      .end();
}

std::string table(const std::vector<GaugeResult>& gauges) {
  static constexpr char row[] = "%-12s %8s %8s %8s   %7s %7s   %7s %7s   %7s %7s\n";
  std::string lines = formatted("\n%-12s %8s %8s %8s   %15s   %15s   %15s\n", "gauge", "rmse", "in wave",
                                "max", "peak [cm]", "at [s]", "arrival [s]");
  lines += formatted(row, "", "[mm]", "[mm]", "[mm]", "run", "meas.", "run", "meas.", "run", "meas.");
  const auto mm = [](double m) { return decimal(m, 1e-3, 2); };
  const auto cm = [](double m) { return decimal(m, 1e-2, 2); };
  const auto s = [](double t) { return decimal(t, 1, 2); };
  for (const auto& g : gauges)
    lines += formatted(row, g.name.c_str(), mm(g.rmse).c_str(), mm(g.rmse_window).c_str(),
                       mm(g.max_abs_error).c_str(), cm(g.peak).c_str(), cm(g.measured_peak).c_str(),
                       s(g.peak_time).c_str(), s(g.measured_peak_time).c_str(), s(g.arrival).c_str(),
                       s(g.measured_arrival).c_str());
  return lines;
}

}  // namespace

GaugeRecorder::GaugeRecorder(const Scene& scene, const std::string& directory)
    : gauges_(scene.gauges),
      directory_(directory),
      row_times_(regular_times(interval(scene), scene.end_time)),
      file_(path_in(directory, "gauges.csv")) {}

void GaugeRecorder::begin(const Method& method) {
  file_.create(gauges_);
  write_measured(path_in(directory_, "measured.csv"), gauges_);
  write(0, method.gauge(gauges_));
  row_times_.advance();
}

void GaugeRecorder::before_step(const Method& method, const Clock& clock, const Stride& stride) {
  if (row_times_.next() > stride.until || watched_t_ == clock.t) return;
  watched_ = method.gauge(gauges_);
  watched_t_ = clock.t;
}

void GaugeRecorder::after_step(const Method& method, const Clock& clock) {
  if (!row_times_.due(clock.t)) return;
  const auto now = method.gauge(gauges_);
  for (; row_times_.due(clock.t); row_times_.advance()) {
    const double w = (row_times_.next() - watched_t_) / (clock.t - watched_t_);
    std::vector<PointState> states;
    for (std::size_t g = 0; g < now.size(); ++g) states.push_back(between(watched_[g], now[g], w));
    write(row_times_.next(), states);
  }
  watched_ = now;
  watched_t_ = clock.t;
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

void GaugeRecorder::save(Values& values) const {
  sync_file(path_in(directory_, "gauges.csv"));
  values["gauge_rows"] = {static_cast<double>(rows_.size())};
}

void GaugeRecorder::restore(const Values& values, const Clock& clock) {
  rows_ = file_.continue_after(static_cast<std::size_t>(values.at("gauge_rows").at(0)));
  row_times_.skip_past(clock.t);
}

std::vector<GaugeResult> GaugeRecorder::results() const {
  std::vector<GaugeResult> results;
  for (std::size_t g = 0; g < gauges_.size(); ++g) results.push_back(compare_gauge(gauges_[g], rows_, g));
  return results;
}

void GaugeRecorder::report(const Method&, const Clock&, Report& report) const {
  const auto all = results();
  JsonWriter& out = report.object("gauges");
  for (const GaugeResult& gauge : all) write_json(out, gauge);
  out.end();
  report.tables += table(all);
}

}  // namespace freshet
