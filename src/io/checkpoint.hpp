// state.h5: everything a run needs to go on, in double precision to the bit. Written beside its name, brought
// to the disk and then renamed, so that the last good one outlives a full disk or a crash. Failures are
// IoError.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cellgrid/particles/fields.hpp"

namespace freshet {

using Values = std::map<std::string, std::vector<double>>;

struct Checkpoint {
  std::string scene_file;  // absolute path: the scene's data files are relative to it
  std::string scene_text;  // overrides applied
  Values run;              // clock, effort, and what the observers save
  Values method;           // Method::scalars()
};

// All saved fields go to /reals and /integers with their unit.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint, const FieldSet& fields);

Checkpoint read_checkpoint(const std::string& path);
// Sets the particle count and every stored field; throws if a saved field of `fields` is not in the file.
void read_checkpoint_fields(const std::string& path, FieldSet& fields);

// Calls use(), which looks at what a checkpoint holds with at(): what it lacks is an IoError that says so.
void look_at_checkpoint(const std::string& path, const std::function<void()>& use);

}  // namespace freshet
