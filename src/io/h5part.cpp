#include "src/io/h5part.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/io/fluid.hpp"
#include "src/io/hdf5.hpp"

namespace freshet {
namespace {

const std::string prefix = "Step#";
constexpr std::uint64_t metadata_bytes = 64 * 1024;  // groups and headers of one step, generously

std::string group_name(int step) { return prefix + std::to_string(step); }

std::vector<int> step_numbers(const hdf5::File& file) {
  std::vector<int> steps;
  for (const auto& name : file.names()) {
    if (name.rfind(prefix, 0) == 0) steps.push_back(std::stoi(name.substr(prefix.size())));
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

// What a step may hold of the water's particles, by the names of [output] fields.
class StepColumns {
 public:
  StepColumns(const FieldSet& fields, double spacing) : fields_(fields), spacing_(spacing) {}

  // Those wanted, each once, or of the usual ones those that the method has.
  std::vector<std::string> those_of(const std::optional<std::vector<std::string>>& wanted) const {
    const std::vector<std::string> usual{"z", "depth", "p", "u", "v", "surface", "size"};
    std::vector<std::string> names;
    for (const std::string& name : wanted ? *wanted : usual) {
      if (wanted && !has(name)) throw std::logic_error("output.fields: the method has no field " + name);
      if (has(name) && std::count(names.begin(), names.end(), name) == 0) names.push_back(name);
    }
    return names;
  }
  std::string unit(const std::string& name) const {
    if (name == "z") return "m (free surface)";
    if (name == "bed" || name == "size") return "m";
    const auto* real = fields_.find_real(name);
    return real ? real->unit : fields_.find_integer(name)->unit;
  }
  void write(const hdf5::Group& group, const std::string& name, const std::vector<int>& water) const {
    if (const auto* integer = fields_.find_integer(name)) return group.write(name, gather(integer, water));
    group.write(dataset(name), values(name, water), hdf5::Stored::float32);
  }
  static std::string dataset(const std::string& name) {
    return name == "u" ? "v_0" : name == "v" ? "v_1" : name;
  }

 private:
  bool has(const std::string& name) const {
    if (name == "z" || name == "bed") return fields_.has("depth");
    if (name == "size") return (fields_.has("depth") && fields_.has("mass")) || spacing_ > 0;
    return fields_.has(name);
  }
  // Copied to the host once, though z, depth and size ask for the same.
  const std::vector<double>& real(const std::string& name, const std::vector<int>& water) const {
    const auto known = copied_.find(name);
    return known != copied_.end() ? known->second : copied_[name] = gather(fields_.find_real(name), water);
  }
  std::vector<double> values(const std::string& name, const std::vector<int>& water) const {
    if (name == "size") return sizes(water);
    if (name != "z") return real(name, water);
    std::vector<double> z = real("bed", water);
    const std::vector<double>& depth = real("depth", water);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += depth[k];
    return z;
  }
  // m, of a square (in 1-D an interval) as large as what the particle covers; 0 where it is dry.
  std::vector<double> sizes(const std::vector<int>& water) const {
    if (fields_.has("dx")) return real("dx", water);
    if (!fields_.has("depth")) return std::vector<double>(water.size(), spacing_);
    std::vector<double> size = real("mass", water);
    const std::vector<double>& depth = real("depth", water);
    for (std::size_t k = 0; k < size.size(); ++k) {
      const double area = depth[k] > 0 ? size[k] / depth[k] : 0;
      size[k] = fields_.has("y") ? std::sqrt(area) : area;
    }
    return size;
  }

  const FieldSet& fields_;
  double spacing_;
  mutable std::map<std::string, std::vector<double>> copied_;
};

// From "x m, z m (free surface), id 1": the word after the name.
std::string unit_in(const std::string& units, const std::string& name) {
  std::istringstream words(", " + units);
  for (std::string before, word; words >> word; before = word)
    if (!before.empty() && before.back() == ',' && word == name && words >> word)
      return word.substr(0, word.find(','));
  return "";
}

// Not stored as float32.
bool is_long(const std::string& name) { return name == "x" || name == "y" || name == "id"; }

std::vector<std::string> in_order(std::vector<std::string> names) {
  const std::vector<std::string> first{"x", "y", "z", "depth", "v_0", "v_1", "p"};
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return std::find(first.begin(), first.end(), a) < std::find(first.begin(), first.end(), b);
  });
  return names;
}

}  // namespace

void ParticleFile::create(const std::string& scene_text, const std::string& version,
                          const FieldSet& fields) const {
  require_space(folder_of(path_), metadata_bytes + scene_text.size());
  const StepColumns columns(fields, spacing_);
  std::string units = "x m, y m, ";
  for (const std::string& name : columns.those_of(wanted_))
    units += StepColumns::dataset(name) + ' ' + columns.unit(name) + ", ";
  auto file = hdf5::File::make(path_);
  {
    const auto about = file.create("freshet");
    about.write("scene", scene_text);
    about.attribute("version", version);
    about.attribute("units", units + "id 1, TimeValue s");
  }
  file.close();
}

void ParticleFile::append(int step, double t, const FieldSet& fields) const {
  const StepColumns columns(fields, spacing_);
  const std::vector<std::string> names = columns.those_of(wanted_);
  const std::vector<int> water = fluid_indices(fields);
  reserve_space(path_, metadata_bytes + water.size() * (2 * 8 + 4 * (names.size() + 1)));
  auto file = hdf5::File::change(path_);
  {
    const auto group = file.create(group_name(step));
    group.attribute("TimeValue", t);
    for (const char* name : {"x", "y"}) group.write(name, gather(fields.find_real(name), water));
    for (const std::string& name : names) columns.write(group, name, water);
    group.write("id", gather(fields.find_integer("id"), water));
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
  const std::string units = file.open("freshet").text_attribute("units");
  for (const std::string& name : in_order(group.names()))
    read.columns.push_back({name, unit_in(units, name), is_long(name) ? 12 : 8, group.reals(name)});
  return read;
}

const std::vector<double>& ParticleStep::operator[](const std::string& name) const {
  static const std::vector<double> none;
  for (const ParticleColumn& column : columns)
    if (column.name == name) return column.values;
  return none;
}

}  // namespace freshet
