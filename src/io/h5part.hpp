// particles.h5part: one group Step#k per output with 1-D arrays x, y [m, float64: UTM positions keep all
// digits], id, and in float32 the fields asked for, else z = free-surface elevation [m], depth [m], v_0, v_1
// [m/s], p [Pa], surface and size [m], those of them that the method has; attribute TimeValue [s]. size: the
// side of a square (in 1-D the length) that the particle covers. The group /freshet holds the scene's text,
// the program's version and the units. The file is open only while a step is appended, so that it can be
// read during a run and survives a killed one. Failures are IoError.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cellgrid/particles/fields.hpp"

namespace freshet {

class ParticleFile {
 public:
  // wanted: names of [output] fields. spacing [m]: the size of points without a depth that carry none.
  explicit ParticleFile(std::string path, std::optional<std::vector<std::string>> wanted = {},
                        double spacing = 0)
      : path_(std::move(path)), wanted_(std::move(wanted)), spacing_(spacing) {}

  void create(const std::string& scene_text, const std::string& version, const FieldSet& fields) const;
  void append(int step, double t, const FieldSet& fields) const;
  void truncate(int steps) const;  // removes Step#k with k >= steps

 private:
  std::string path_;
  std::optional<std::vector<std::string>> wanted_;
  double spacing_;
};

struct ParticleColumn {
  std::string name, unit;
  int digits;  // that tell stored values apart: 12 of places and ids, 8 of float32
  std::vector<double> values;
};

struct ParticleStep {
  int step = 0;
  double t = 0;  // s
  // x, y, z, depth, v_0, v_1, p, those of them that the file has, then the others
  std::vector<ParticleColumn> columns;

  const std::vector<double>& operator[](const std::string& name) const;  // empty where the file has none
  std::size_t size() const { return (*this)["x"].size(); }
};

struct StepTime {
  int step;
  double t;  // s
};

std::vector<StepTime> list_particle_steps(const std::string& path);
ParticleStep read_particle_step(const std::string& path, int step);

}  // namespace freshet
