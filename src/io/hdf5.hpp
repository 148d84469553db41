// RAII over the HDF5 C API; hdf5.cpp is the only file that includes it. Every failure is an IoError that
// names the file, the object and HDF5's innermost reason (such as "No space left on device").
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace freshet::hdf5 {

enum class Stored { float32, float64 };

// Owns one HDF5 identifier and the function that closes it.
class Handle {
 public:
  using Close = int (*)(std::int64_t);
  Handle() = default;
  Handle(std::int64_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { close(); }

  std::int64_t id() const { return id_; }
  int close();  // negative if HDF5 reports a failure; the handle is empty afterwards

 private:
  std::int64_t id_ = -1;
  Close close_ = nullptr;
};

// A group of a file, and through File its root. Names are relative to the group. Valid while its File lives.
class Group {
 public:
  Group create(const std::string& name) const;
  Group open(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  // in alphabetical order
  void remove(const std::string& name) const;

  void write(const std::string& name, const double* values, std::size_t count, Stored stored) const;
  void write(const std::string& name, const int* values, std::size_t count) const;
  void write(const std::string& name, const std::vector<double>& values,
             Stored stored = Stored::float64) const;
  void write(const std::string& name, const std::vector<int>& values) const;
  void write(const std::string& name, const std::string& text) const;
  std::vector<double> reals(const std::string& name) const;
  std::vector<int> integers(const std::string& name) const;
  std::string text(const std::string& name) const;

  // Attributes of the group (name of an object inside it = "" for itself).
  void attribute(const std::string& name, double value, const std::string& object = "") const;
  void attribute(const std::string& name, const std::string& value, const std::string& object = "") const;
  double real_attribute(const std::string& name, const std::string& object = "") const;
  std::string text_attribute(const std::string& name, const std::string& object = "") const;

 protected:
  Group(Handle handle, std::string where) : handle_(std::move(handle)), where_(std::move(where)) {}
  [[noreturn]] void fail(const std::string& action) const;
  std::int64_t expect(std::int64_t result, const std::string& action) const;  // result, or throws if negative

  Handle handle_;
  std::string where_;  // "out/okushiri/particles.h5part:/Step#3"
};

class File : public Group {
 public:
  static File make(const std::string& path);    // replaces an existing file
  static File look(const std::string& path);    // to read only
  static File change(const std::string& path);  // to read and write
  void close();                                 // flushes; throws if anything could not be written

 private:
  using Group::Group;
};

}  // namespace freshet::hdf5
