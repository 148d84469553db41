#include "src/io/checkpoint.hpp"

#include <filesystem>

#include "cellgrid/parallel/assign.hpp"
#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/io/hdf5.hpp"

namespace freshet {
namespace {

constexpr double format = 1;
constexpr std::uint64_t metadata_bytes = 128 * 1024;

std::uint64_t bytes_of(const Values& values) {
  std::uint64_t bytes = 0;
  for (const auto& [name, value] : values) bytes += value.size() * sizeof(double);
  return bytes;
}

template <class T>
std::uint64_t bytes_of(const std::vector<NamedField<T>>& fields, int size) {
  std::uint64_t bytes = 0;
  for (const auto& field : fields)
    bytes += is_saved(field.carry) ? sizeof(T) * static_cast<unsigned>(size) : 0;
  return bytes;
}

std::uint64_t bytes_of(const Checkpoint& checkpoint, const FieldSet& fields) {
  return bytes_of(fields.reals(), fields.size()) + bytes_of(fields.integers(), fields.size()) +
         bytes_of(checkpoint.run) + bytes_of(checkpoint.method) + checkpoint.scene_text.size() +
         metadata_bytes;
}

template <class T>
void write_fields(const hdf5::Group& group, const std::vector<NamedField<T>>& fields, int size) {
  for (const auto& field : fields) {
    if (!is_saved(field.carry)) continue;
    const auto data = on_host(field.data);
    group.write(field.name, std::vector<T>(data.data(), data.data() + size));
    group.attribute("unit", field.unit, field.name);
  }
}

void write_values(const hdf5::Group& group, const Values& values) {
  for (const auto& [name, value] : values) group.write(name, value);
}

Values read_values(const hdf5::Group& group) {
  Values values;
  for (const auto& name : group.names()) values[name] = group.reals(name);
  return values;
}

template <class T>
void require_fields(const hdf5::Group& group, const std::vector<NamedField<T>>& fields,
                    const std::string& path) {
  for (const auto& field : fields) {
    if (is_saved(field.carry) && !group.has(field.name)) {
      throw IoError(path + ": holds no field " + field.name +
                    "\n  help: another version of the program wrote it; start the run anew");
    }
  }
}

// The room is reserved first: HDF5 does not recover from a write that fails.
void write_all(const std::string& path, const Checkpoint& checkpoint, const FieldSet& fields) {
  hdf5::File::make(path).close();
  reserve_space(path, bytes_of(checkpoint, fields));
  auto file = hdf5::File::change(path);
  {
    file.attribute("format", format);
    file.attribute("particles", fields.size());
    file.write("scene_file", checkpoint.scene_file);
    file.write("scene", checkpoint.scene_text);
    write_values(file.create("run"), checkpoint.run);
    write_values(file.create("method"), checkpoint.method);
    write_fields(file.create("reals"), fields.reals(), fields.size());
    write_fields(file.create("integers"), fields.integers(), fields.size());
  }
  file.close();
}

}  // namespace

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint, const FieldSet& fields) {
  const std::string temporary = path + ".new";
  require_space(folder_of(path), bytes_of(checkpoint, fields));
  try {
    write_all(temporary, checkpoint, fields);
    replace_file(temporary, path);
  } catch (const IoError&) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

Checkpoint read_checkpoint(const std::string& path) {
  const auto file = hdf5::File::look(path);
  if (file.real_attribute("format") != format) {
    throw IoError(path + ": another version of the program wrote it; start the run anew");
  }
  return {file.text("scene_file"), file.text("scene"), read_values(file.open("run")),
          read_values(file.open("method"))};
}

void read_checkpoint_fields(const std::string& path, FieldSet& fields) {
  const auto file = hdf5::File::look(path);
  const auto reals = file.open("reals"), integers = file.open("integers");
  require_fields(reals, fields.reals(), path);
  require_fields(integers, fields.integers(), path);
  fields.resize(static_cast<int>(file.real_attribute("particles")));
  for (const auto& name : reals.names()) {
    upload(fields.real(name, reals.text_attribute("unit", name), Carry::state), reals.reals(name));
  }
  for (const auto& name : integers.names()) {
    upload(fields.integer(name, integers.text_attribute("unit", name), Carry::state),
           integers.integers(name));
  }
}

void look_at_checkpoint(const std::string& path, const std::function<void()>& use) try {
  use();
} catch (const std::out_of_range&) {
  throw IoError(path +
                ": lacks what this version looks at; another version of the program wrote it\n  help: start "
                "the run anew");
}

}  // namespace freshet
