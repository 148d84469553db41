// Transects: the surface along lines at the times the scene names ([[profile]]); steps end exactly on them.
// Results go to profiles.csv: one row per point with name, time, place on the line, elevation (the bed level
// where dry), depth and, at the places of the measured points, the measured elevation. Failures to write are
// IoError.
#pragma once
#include "src/run/observe/observer.hpp"

namespace freshet {

struct TransectResult {
  std::string name;
  double time = unknown;                           // s
  double rmse = unknown, max_abs_error = unknown;  // m, over the measured points on the line
  double measured_range = unknown;                 // m, highest less lowest of them
  int points = 0;
};

class TransectRecorder : public Observer {
 public:
  static bool wanted(const Scene& scene) { return !scene.profiles.empty(); }
  static std::vector<std::string> files() { return {"profiles.csv"}; }
  TransectRecorder(const Scene& scene, const std::string& directory);

  void take(const Method& method, const Clock& clock) override;  // those of this time; writes the file anew
  void save(Values& values) const override;
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  std::vector<TransectResult> results() const;  // in the order of the scene; unknown where not taken yet

 private:
  struct Taken {
    std::vector<double> elevation, depth;  // m, at places(); empty = not yet
  };
  void write() const;

  std::vector<Transect> transects_;
  std::vector<Taken> taken_;
  std::string path_;
};

}  // namespace freshet
