#include "src/run/record/particles.hpp"

#include <filesystem>

#include "src/io/build.hpp"
#include "src/io/files.hpp"

namespace freshet {

ParticleRecorder::ParticleRecorder(const Scene& scene, const std::string& directory)
    : Observer(regular_times(scene.output.every, scene.end_time)),
      path_(path_in(directory, "particles.h5part")), scene_text_(scene.text),
      file_(path_, scene.output.fields, scene.fpm ? scene.water.spacing : 0) {}

void ParticleRecorder::begin(const Method& method) {
  file_.create(scene_text_, build::version, method.fields());
}

void ParticleRecorder::append(const Method& method, const Clock& clock) const {
  if (!std::filesystem::exists(path_)) file_.create(scene_text_, build::version, method.fields());
  file_.append(static_cast<int>(times.done()), clock.t, method.fields());
}

void ParticleRecorder::take(const Method& method, const Clock& clock) {
  const TimedRegion region("run::output");
  append(method, clock);
}

// After a resume from which somebody took the file away there is none until the next output.
void ParticleRecorder::save(Values&) const {
  if (std::filesystem::exists(path_)) sync_file(path_);
}

void ParticleRecorder::restore(const Values&, const Clock&) {
  if (std::filesystem::exists(path_)) file_.truncate(static_cast<int>(times.done()));
}

}  // namespace freshet
