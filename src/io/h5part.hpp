// particles.h5part: one group Step#k per output with 1-D arrays x, y [m, float64: UTM positions keep all
// digits], z = free-surface elevation [m], depth [m], v_0, v_1 [m/s] (float32) and id; attribute TimeValue
// [s]. The group /freshet holds the scene's text, the program's version and the units. The file is open only
// while a step is appended, so that it can be read during a run and survives a killed one. Failures are
// IoError.
#pragma once
#include <string>
#include <vector>

#include "cellgrid/fields.hpp"

namespace freshet {

class ParticleFile {
 public:
  explicit ParticleFile(std::string path) : path_(std::move(path)) {}

  void create(const std::string& scene_text, const std::string& version) const;
  void append(int step, double t, const FieldSet& fields) const;
  void truncate(int steps) const;  // removes Step#k with k >= steps

 private:
  std::string path_;
};

struct ParticleStep {
  int step = 0;
  double t = 0;  // s
  std::vector<double> x, y, z, depth, v_0, v_1;
  std::vector<int> id;
};

struct StepTime {
  int step;
  double t;  // s
};

std::vector<StepTime> list_particle_steps(const std::string& path);
ParticleStep read_particle_step(const std::string& path, int step);

}  // namespace freshet
