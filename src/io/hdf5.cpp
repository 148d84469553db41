#include "src/io/hdf5.hpp"

#include <hdf5.h>

#include <utility>

#include "src/errors.hpp"

namespace freshet::hdf5 {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "HDF5 1.10 or later: identifiers of 64 bits");

// After a failed close HDF5 would try again at exit and print its own stack: errors are ours to report.
void start() {
  static const bool started = [] {
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  (void)started;
}

// The innermost entry carries the reason, often "file write failed: ..., error message = 'No space left on
// device', ...".
herr_t keep_first(unsigned depth, const H5E_error2_t* entry, void* text) {
  if (depth == 0 && entry->desc) *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

std::string reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  const auto from = text.find("error message = '");
  if (from == std::string::npos) return text.empty() ? "no reason given" : text;
  const auto begin = from + 17;
  return text.substr(begin, text.find('\'', begin) - begin);
}

[[noreturn]] void fail_at(const std::string& where, const std::string& action) {
  throw IoError(where + ": " + action + ": " + reason());
}

int close_file(std::int64_t id) { return H5Fclose(id); }
int close_group(std::int64_t id) { return H5Gclose(id); }
int close_object(std::int64_t id) { return H5Oclose(id); }
int close_space(std::int64_t id) { return H5Sclose(id); }
int close_set(std::int64_t id) { return H5Dclose(id); }
int close_type(std::int64_t id) { return H5Tclose(id); }
int close_attribute(std::int64_t id) { return H5Aclose(id); }
int close_list(std::int64_t id) { return H5Pclose(id); }

// Closing a file closes what is still open inside it, so that an exception cannot keep it open.
Handle strong_close() {
  Handle list(H5Pcreate(H5P_FILE_ACCESS), close_list);
  H5Pset_fclose_degree(list.id(), H5F_CLOSE_STRONG);
  return list;
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), close_type);
  H5Tset_size(type.id(), length ? length : 1);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

std::string trimmed(std::string text) { return text.substr(0, text.find('\0')); }

herr_t collect(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

int Handle::close() {
  const int status = id_ >= 0 ? close_(id_) : 0;
  id_ = -1;
  return status;
}

void Group::fail(const std::string& action) const { fail_at(where_, action); }

std::int64_t Group::expect(std::int64_t result, const std::string& action) const {
  if (result < 0) fail(action);
  return result;
}

Group Group::create(const std::string& name) const {
  const auto id = H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  return Group(Handle(expect(id, "cannot create group " + name), close_group), where_ + "/" + name);
}

Group Group::open(const std::string& name) const {
  const auto id = H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT);
  return Group(Handle(expect(id, "has no group " + name), close_group), where_ + "/" + name);
}

bool Group::has(const std::string& name) const {
  return expect(H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT), "cannot look for " + name) > 0;
}

std::vector<std::string> Group::names() const {
  std::vector<std::string> found;
  expect(H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &found), "cannot be listed");
  return found;
}

void Group::remove(const std::string& name) const {
  expect(H5Ldelete(handle_.id(), name.c_str(), H5P_DEFAULT), "cannot remove " + name);
}

namespace {

// The reason must be asked for before any handle closes: that clears HDF5's error stack.
struct ObjectPlace {
  std::int64_t in;          // group or object
  const std::string& name;  // of the data set or attribute in it
  const std::string& where;

  void expect(std::int64_t result, const std::string& action) const {
    if (result < 0) fail_at(where, action + " " + name);
  }
};

void write_set(const ObjectPlace& at, const void* values, std::size_t count, hid_t from, hid_t stored) {
  const hsize_t extent = count;
  Handle space(H5Screate_simple(1, &extent, nullptr), close_space);
  at.expect(space.id(), "cannot size");
  Handle set(H5Dcreate2(at.in, at.name.c_str(), stored, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             close_set);
  at.expect(set.id(), "cannot create");
  at.expect(H5Dwrite(set.id(), from, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "cannot write");
  at.expect(set.close(), "cannot close");
}

template <class T>
std::vector<T> read_set(const ObjectPlace& at, hid_t into) {
  Handle set(H5Dopen2(at.in, at.name.c_str(), H5P_DEFAULT), close_set);
  at.expect(set.id(), "has no");
  Handle space(H5Dget_space(set.id()), close_space);
  const auto count = H5Sget_simple_extent_npoints(space.id());
  at.expect(count, "cannot size");
  std::vector<T> values(static_cast<std::size_t>(count));
  at.expect(H5Dread(set.id(), into, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "cannot read");
  return values;
}

void write_attribute(const ObjectPlace& at, hid_t type, const void* value) {
  if (H5Aexists(at.in, at.name.c_str()) > 0) H5Adelete(at.in, at.name.c_str());
  Handle space(H5Screate(H5S_SCALAR), close_space);
  Handle attribute(H5Acreate2(at.in, at.name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                   close_attribute);
  at.expect(attribute.id(), "cannot create");
  at.expect(H5Awrite(attribute.id(), type, value), "cannot write");
}

Handle open_object(std::int64_t group, const std::string& name) {
  return Handle(H5Oopen(group, name.empty() ? "." : name.c_str(), H5P_DEFAULT), close_object);
}

}  // namespace

void Group::write(const std::string& name, const double* values, std::size_t count, Stored stored) const {
  const auto type = stored == Stored::float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  write_set({handle_.id(), name, where_}, values, count, H5T_NATIVE_DOUBLE, type);
}

void Group::write(const std::string& name, const int* values, std::size_t count) const {
  write_set({handle_.id(), name, where_}, values, count, H5T_NATIVE_INT, H5T_STD_I32LE);
}

void Group::write(const std::string& name, const std::vector<double>& values, Stored stored) const {
  write(name, values.data(), values.size(), stored);
}

void Group::write(const std::string& name, const std::vector<int>& values) const {
  write(name, values.data(), values.size());
}

// As a data set and not as an attribute: attributes end at 64 KiB.
void Group::write(const std::string& name, const std::string& text) const {
  const Handle type = text_type(text.size());
  Handle space(H5Screate(H5S_SCALAR), close_space);
  Handle set(
      H5Dcreate2(handle_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      close_set);
  expect(set.id(), "cannot create " + name);
  expect(H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), "cannot write " + name);
}

std::vector<double> Group::reals(const std::string& name) const {
  return read_set<double>({handle_.id(), name, where_}, H5T_NATIVE_DOUBLE);
}

std::vector<int> Group::integers(const std::string& name) const {
  return read_set<int>({handle_.id(), name, where_}, H5T_NATIVE_INT);
}

std::string Group::text(const std::string& name) const {
  Handle set(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT), close_set);
  expect(set.id(), "has no " + name);
  Handle type(H5Dget_type(set.id()), close_type);
  std::string text(H5Tget_size(type.id()), '\0');
  expect(H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "cannot read " + name);
  return trimmed(text);
}

void Group::attribute(const std::string& name, double value, const std::string& object) const {
  const Handle target = open_object(handle_.id(), object);
  write_attribute({target.id(), name, where_}, H5T_NATIVE_DOUBLE, &value);
}

void Group::attribute(const std::string& name, const std::string& value, const std::string& object) const {
  const Handle target = open_object(handle_.id(), object), type = text_type(value.size());
  write_attribute({target.id(), name, where_}, type.id(), value.c_str());
}

double Group::real_attribute(const std::string& name, const std::string& object) const {
  const Handle target = open_object(handle_.id(), object);
  Handle attribute(H5Aopen(target.id(), name.c_str(), H5P_DEFAULT), close_attribute);
  expect(attribute.id(), "has no attribute " + name);
  double value = 0;
  expect(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value), "cannot read attribute " + name);
  return value;
}

std::string Group::text_attribute(const std::string& name, const std::string& object) const {
  const Handle target = open_object(handle_.id(), object);
  Handle attribute(H5Aopen(target.id(), name.c_str(), H5P_DEFAULT), close_attribute);
  expect(attribute.id(), "has no attribute " + name);
  Handle type(H5Aget_type(attribute.id()), close_type);
  std::string text(H5Tget_size(type.id()), '\0');
  expect(H5Aread(attribute.id(), type.id(), text.data()), "cannot read attribute " + name);
  return trimmed(text);
}

File File::make(const std::string& path) {
  start();
  const Handle access = strong_close();
  const auto id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id());
  if (id < 0) fail_at(path, "cannot be created");
  return File(Handle(id, close_file), path + ":");
}

namespace {

std::int64_t open_file(const std::string& path, unsigned mode) {
  start();
  const Handle access = strong_close();
  const auto id = H5Fopen(path.c_str(), mode, access.id());
  if (id < 0) fail_at(path, mode == H5F_ACC_RDWR ? "cannot be opened for writing" : "cannot be opened");
  return id;
}

}  // namespace

File File::look(const std::string& path) {
  return File(Handle(open_file(path, H5F_ACC_RDONLY), close_file), path + ":");
}

File File::change(const std::string& path) {
  return File(Handle(open_file(path, H5F_ACC_RDWR), close_file), path + ":");
}

void File::close() {
  if (H5Fflush(handle_.id(), H5F_SCOPE_LOCAL) < 0) fail("cannot be written");
  if (handle_.close() < 0) fail("cannot be closed");
}

}  // namespace freshet::hdf5
