// Gauges: rows of gauges.csv at their own times, which never shorten dt. Between the two steps that bracket a
// gauge time value and base are interpolated linearly.
#pragma once
#include "src/io/gauges.hpp"
#include "src/run/observe/observer.hpp"
#include "src/run/record/gauge_stats.hpp"

namespace freshet {

class GaugeRecorder : public Observer {
 public:
  static bool wanted(const Scene& scene) { return !scene.gauges.empty(); }
  static std::vector<std::string> files() { return {"gauges.csv", "measured.csv"}; }
  GaugeRecorder(const Scene& scene, const std::string& directory);

  void begin(const Method& method) override;  // writes the header and the row at t = 0
  // Samples only if a gauge time lies in the step.
  void before_step(const Method& method, const Clock& clock, const Stride& stride) override;
  void after_step(const Method& method, const Clock& clock) override;
  void save(Values& values) const override;
  // Cuts the file after the rows of the checkpoint.
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  const std::vector<GaugeRow>& rows() const { return rows_; }
  std::vector<GaugeResult> results() const;  // in the order of the scene

 private:
  void write(double t, const std::vector<Reading>& readings);

  std::vector<Gauge> gauges_;
  std::string directory_;
  Timetable row_times_;
  GaugeFile file_;
  std::vector<GaugeRow> rows_;
  double watched_t_ = -1;         // s, time of watched_
  std::vector<Reading> watched_;  // before the step
};

}  // namespace freshet
