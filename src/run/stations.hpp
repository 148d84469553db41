// What is observed at fixed places: gauges (rows of gauges.csv at their own times, which never shorten dt)
// and run-ups.
#pragma once
#include <string>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/io/gauges.hpp"
#include "src/method.hpp"
#include "src/run/events.hpp"

namespace freshet {

constexpr double dry_depth = 1e-4;  // m: a gauge with less water shows the bed level, marked dry

// Between the two steps that bracket a gauge time depth and bed are interpolated linearly.
class GaugeRecorder {
 public:
  GaugeRecorder(const Scene& scene, const std::string& path);

  void begin(const Method& method);  // writes the header and the row at t = 0
  // Before a step from t to `until`: samples only if a gauge time lies in between.
  void watch(const Method& method, double t, double until);
  void record(const Method& method, double t);  // after the step
  const std::vector<GaugeRow>& rows() const { return rows_; }

  void save(Values& values) const;
  void restore(const Values& values);  // cuts the file after the rows of the checkpoint

 private:
  void write(double t, const std::vector<PointState>& states);
  bool absent() const { return gauges_.empty(); }

  std::vector<Gauge> gauges_;
  std::string folder_;
  Timetable times_;
  GaugeFile file_;
  std::vector<GaugeRow> rows_;
  double watched_t_ = -1;            // s, time of watched_
  std::vector<PointState> watched_;  // state before the step
};

// The highest water at each run-up point so far; kept on the device.
class RunUpRecorder {
 public:
  explicit RunUpRecorder(const std::vector<RunUp>& points);
  void record(const Method& method);
  std::vector<WetLevels> highest() const;

  void save(Values& values) const;
  void restore(const Values& values);

 private:
  Shores shores_;
};

}  // namespace freshet
