// Particles: one step of particles.h5part at each time of output.
#pragma once
#include "src/io/h5part.hpp"
#include "src/run/observe/observer.hpp"

namespace freshet {

class ParticleRecorder : public Observer {
 public:
  static std::vector<std::string> files() { return {"particles.h5part"}; }
  ParticleRecorder(const Scene& scene, const std::string& directory);

  void begin(const Method& method) override;
  void take(const Method& method, const Clock& clock) override;
  void diverged(const Method& method, const Clock& clock) override { append(method, clock); }
  void save(Values& values) const override;
  // Cuts the file after the outputs of the checkpoint.
  void restore(const Values& values, const Clock& clock) override;

 private:
  void append(const Method& method, const Clock& clock) const;

  std::string path_, scene_text_;
  ParticleFile file_;
};

}  // namespace freshet
