#include "src/io/h5part.hpp"

#include <algorithm>
#include <filesystem>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/io/fluid.hpp"
#include "src/io/hdf5.hpp"

namespace freshet {
namespace {

const std::string prefix = "Step#";
const char* const units = "x m, y m, z m (free surface), depth m, p Pa, v_0 m/s, v_1 m/s, id 1, TimeValue s";
constexpr std::uint64_t metadata_bytes = 64 * 1024;  // groups and headers of one step, generously

std::string group_name(int step) { return prefix + std::to_string(step); }

std::vector<double> surface(const Fluid& fluid) {
  std::vector<double> z(fluid.size());
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = fluid.bed[i] + fluid.depth[i];
  return z;
}

std::vector<int> step_numbers(const hdf5::File& file) {
  std::vector<int> steps;
  for (const auto& name : file.names()) {
    if (name.rfind(prefix, 0) == 0) steps.push_back(std::stoi(name.substr(prefix.size())));
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

std::string folder_of(const std::string& path) {
  const auto parent = std::filesystem::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

// What incompressible methods have instead of a depth.
void write_pressure(const hdf5::Group& group, const FieldSet& fields) {
  const auto n = static_cast<std::size_t>(fields.size());
  const auto p = on_host(fields.real("p"));
  const auto flag = on_host(fields.integer("surface"));
  group.write("p", std::vector<double>(p.data(), p.data() + n), hdf5::Stored::float32);
  group.write("surface", std::vector<int>(flag.data(), flag.data() + n));
}

}  // namespace

void ParticleFile::create(const std::string& scene_text, const std::string& version) const {
  require_space(folder_of(path_), metadata_bytes + scene_text.size());
  auto file = hdf5::File::make(path_);
  {
    const auto about = file.create("freshet");
    about.write("scene", scene_text);
    about.attribute("version", version);
    about.attribute("units", units);
  }
  file.close();
}

void ParticleFile::append(int step, double t, const FieldSet& fields) const {
  const Fluid fluid = fluid_on_host(fields);
  reserve_space(path_, metadata_bytes + fluid.size() * (2 * 8 + 5 * 4));
  auto file = hdf5::File::change(path_);
  {
    const auto group = file.create(group_name(step));
    group.attribute("TimeValue", t);
    group.write("x", fluid.x);
    group.write("y", fluid.y);
    if (fields.find_real("depth")) {
      group.write("z", surface(fluid), hdf5::Stored::float32);
      group.write("depth", fluid.depth, hdf5::Stored::float32);
    }
    group.write("v_0", fluid.u, hdf5::Stored::float32);
    if (fields.find_real("v")) group.write("v_1", fluid.v, hdf5::Stored::float32);
    group.write("id", fluid.id);
    if (fields.find_real("p")) write_pressure(group, fields);
  }
  file.close();
}

void ParticleFile::truncate(int steps) const {
  auto file = hdf5::File::change(path_);
  for (const int step : step_numbers(file)) {
    if (step >= steps) file.remove(group_name(step));
  }
  file.close();
}

std::vector<StepTime> list_particle_steps(const std::string& path) {
  const auto file = hdf5::File::look(path);
  std::vector<StepTime> steps;
  for (const int step : step_numbers(file)) {
    steps.push_back({step, file.open(group_name(step)).real_attribute("TimeValue")});
  }
  return steps;
}

ParticleStep read_particle_step(const std::string& path, int step) {
  const auto file = hdf5::File::look(path);
  if (!file.has(group_name(step))) {
    const auto steps = step_numbers(file);
    throw SceneError(
        path + ": no step " + std::to_string(step) +
        (steps.empty() ? ": the file holds none" : "; the last is " + std::to_string(steps.back())));
  }
  const auto group = file.open(group_name(step));
  ParticleStep read;
  read.step = step;
  read.t = group.real_attribute("TimeValue");
  read.x = group.reals("x");
  read.y = group.reals("y");
  read.z = group.has("z") ? group.reals("z") : std::vector<double>(read.x.size(), 0.0);
  read.depth = group.has("depth") ? group.reals("depth") : read.z;
  read.v_0 = group.reals("v_0");
  if (group.has("v_1")) read.v_1 = group.reals("v_1");
  read.id = group.integers("id");
  return read;
}

}  // namespace freshet
