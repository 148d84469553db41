// The surface along lines at the times the scene names ([[profile]]); steps end exactly on them. Failures to write are IoError.
#pragma once
#include <string>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/io/summary.hpp"
#include "src/method.hpp"

namespace freshet {

// Increasing, each time once.
std::vector<double> profile_times(const Scene& scene);

class ProfileRecorder {
 public:
  // Results go to `path` (profiles.csv): one row per point with profile, time, place on the line, elevation (the bed level where
  // dry), depth and, at the places of the measured points, the measured elevation. No profiles: nothing is written or sampled.
  ProfileRecorder(const Scene& scene, std::string path);

  void record(const Method& method, double t);  // takes the profiles of this time and writes the file anew
  std::vector<ProfileResult> results() const;   // in the order of the scene; unknown where not taken yet

  void save(Values& values) const;
  void restore(const Values& values);

 private:
  struct Taken {
    std::vector<double> elevation, depth;  // m, at places(); empty = not yet
  };
  std::vector<double> places(const Transect& profile) const;  // m, the written points, then the measured ones on the line
  void write() const;

  std::vector<Transect> profiles_;
  std::vector<Taken> taken_;
  std::string path_;
};

}  // namespace freshet
