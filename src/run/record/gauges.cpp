#include "src/run/record/gauges.hpp"

#include <algorithm>

#include "src/io/files.hpp"

namespace freshet {
namespace {

double lerp(double a, double b, double w) { return a + w * (b - a); }

constexpr char columns[] = "%-12s %8s %8s %8s   %7s %7s   %7s %7s   %7s %7s\n";

double interval(const Scene& scene) {
  return scene.output.gauges_every > 0 ? scene.output.gauges_every : scene.output.every;
}

Reading between(const Reading& a, const Reading& b, double w) {
  const double value = lerp(a.wet ? a.value : 0, b.wet ? b.value : 0, w);
  return {value, lerp(a.base, b.base, w), a.wet || b.wet, b.film};
}

void write_json(JsonWriter& out, const GaugeResult& gauge, const Measurand& shown) {
  out.begin(gauge.name)
      .value("shows", std::string(shown.name))
      .value("unit", std::string(shown.unit))
      .value("rmse", gauge.rmse)
      .value("rmse_window", gauge.rmse_window)
      .value("window_start", gauge.window.first)
      .value("window_end", gauge.window.second)
      .value("max_abs_error", gauge.max_abs_error)
      .value("peak", gauge.peak)
      .value("peak_time", gauge.peak_time)
      .value("measured_peak", gauge.measured_peak)
      .value("measured_peak_time", gauge.measured_peak_time)
      .value("arrival", gauge.arrival)
      .value("measured_arrival", gauge.measured_arrival)
      .value("dry_fraction", gauge.dry)
      .end();
}

std::string row(const GaugeResult& g, const Measurand& shown) {
  const auto fine = [&](double x) { return decimal(x, shown.fine.size, 2); };
  const auto coarse = [&](double x) { return decimal(x, shown.coarse.size, 2); };
  const auto s = [](double t) { return decimal(t, 1, 2); };
  return formatted(columns, g.name.c_str(), fine(g.rmse).c_str(), fine(g.rmse_window).c_str(),
                   fine(g.max_abs_error).c_str(), coarse(g.peak).c_str(), coarse(g.measured_peak).c_str(),
                   s(g.peak_time).c_str(), s(g.measured_peak_time).c_str(), s(g.arrival).c_str(),
                   s(g.measured_arrival).c_str());
}

bool same_unit(const Measurand& a, const Measurand& b) { return a.unit == std::string(b.unit); }

// The gauges that show something in this unit.
std::string table(const std::vector<Gauge>& gauges, const std::vector<GaugeResult>& results,
                  const Measurand& shown) {
  std::string rows;
  for (std::size_t g = 0; g < gauges.size(); ++g)
    if (same_unit(gauges[g].measurand(), shown)) rows += row(results[g], shown);
  const std::string fine = formatted("[%s]", shown.fine.unit),
                    peak = formatted("peak [%s]", shown.coarse.unit);
  return formatted("\n%-12s %8s %8s %8s   %15s   %15s   %15s\n", "gauge", "rmse", "in wave", "max",
                   peak.c_str(), "at [s]", "arrival [s]") +
         formatted(columns, "", fine.c_str(), fine.c_str(), fine.c_str(), "run", "meas.", "run", "meas.",
                   "run", "meas.") +
         rows;
}

}  // namespace

GaugeRecorder::GaugeRecorder(const Scene& scene, const std::string& directory)
    : gauges_(scene.gauges), directory_(directory),
      row_times_(regular_times(interval(scene), scene.end_time)), file_(path_in(directory, "gauges.csv")) {}

void GaugeRecorder::begin(const Method& method) {
  file_.create(gauges_);
  write_measured(path_in(directory_, "measured.csv"), gauges_);
  write(0, method.read(gauges_));
  row_times_.advance();
}

void GaugeRecorder::before_step(const Method& method, const Clock& clock, const Stride& stride) {
  if (row_times_.next() > stride.until || watched_t_ == clock.t) return;
  watched_ = method.read(gauges_);
  watched_t_ = clock.t;
}

void GaugeRecorder::after_step(const Method& method, const Clock& clock) {
  if (!row_times_.due(clock.t)) return;
  const auto now = method.read(gauges_);
  for (; row_times_.due(clock.t); row_times_.advance()) {
    const double w = (row_times_.next() - watched_t_) / (clock.t - watched_t_);
    std::vector<Reading> readings;
    for (std::size_t g = 0; g < now.size(); ++g) readings.push_back(between(watched_[g], now[g], w));
    write(row_times_.next(), readings);
  }
  watched_ = now;
  watched_t_ = clock.t;
}

void GaugeRecorder::write(double t, const std::vector<Reading>& readings) {
  GaugeRow row;
  row.t = t;
  for (const Reading& r : readings) {
    const bool dry = !r.wet || r.value < r.film;
    row.value.push_back(dry ? r.base : r.base + r.value);
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
  for (std::size_t g = 0; g < all.size(); ++g) write_json(out, all[g], gauges_[g].measurand());
  out.end();
  for (std::size_t g = 0; g < gauges_.size(); ++g) {  // a table where a unit is the first of its kind
    const auto same = [&](const Gauge& other) {
      return same_unit(other.measurand(), gauges_[g].measurand());
    };
    if (std::none_of(gauges_.begin(), gauges_.begin() + static_cast<long>(g), same))
      report.tables += table(gauges_, all, gauges_[g].measurand());
  }
}

}  // namespace freshet
