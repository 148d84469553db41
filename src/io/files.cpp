#include "src/io/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/errors.hpp"

namespace freshet {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& action, int error) {
  std::string text = path + ": " + action + ": " + std::strerror(error);
  if (error == ENOSPC || error == EDQUOT || error == EFBIG)
    text += "\n  help: free some space, or choose another directory with --out";
  if (error == EACCES || error == EROFS)
    text += "\n  help: choose a directory that you may write to with --out";
  throw IoError(text);
}

void sync(const std::string& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags);
  if (descriptor < 0) fail(path, "cannot be opened", errno);
  const int status = ::fsync(descriptor), error = errno;
  ::close(descriptor);
  if (status != 0) fail(path, "cannot be written to disk", error);
}

}  // namespace

std::string folder_of(const std::string& path) {
  const auto parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

std::string path_in(const std::string& directory, const std::string& name) {
  return (fs::path(directory) / name).string();
}

void make_directory(const std::string& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) fail(directory, "cannot make this directory", error.value());
  if (!fs::is_directory(directory)) fail(directory, "results need a directory", ENOTDIR);
  if (::access(directory.c_str(), W_OK) != 0) fail(directory, "cannot write into this directory", errno);
}

void require_space(const std::string& directory, std::uint64_t bytes) {
  std::error_code error;
  const auto space = fs::space(directory, error);
  if (error || space.available >= bytes) return;
  fail(directory,
       "the next output needs " + std::to_string(bytes >> 10) + " KiB, free are " +
           std::to_string(space.available >> 10) + " KiB",
       ENOSPC);
}

void reserve_space(const std::string& path, std::uint64_t bytes) {
  const int descriptor = ::open(path.c_str(), O_RDWR);
  if (descriptor < 0) fail(path, "cannot be opened for writing", errno);
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  const int error = ::posix_fallocate(descriptor, size, static_cast<off_t>(bytes));
  const bool restored = error == 0 || ::ftruncate(descriptor, size) == 0;
  ::close(descriptor);
  if (error != 0 || !restored) fail(path, "cannot grow by " + std::to_string(bytes >> 10) + " KiB", error);
}

void sync_file(const std::string& path) { sync(path, O_RDONLY); }

void replace_file(const std::string& temporary, const std::string& path) {
  sync_file(temporary);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot be replaced", errno);
  sync(folder_of(path), O_RDONLY | O_DIRECTORY);
}

void write_text(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".new";
  errno = 0;
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  if (!file) fail(temporary, "cannot be written", errno);
  replace_file(temporary, path);
}

std::string read_text(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) fail(path, "cannot be read", errno);
  return text.str();
}

}  // namespace freshet
