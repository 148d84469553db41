// Files and directories with the failures spelled out: what, path, reason, remedy (IoError).
#pragma once
#include <cstdint>
#include <string>

namespace freshet {

std::string folder_of(const std::string& path);
std::string path_in(const std::string& directory, const std::string& name);

// Makes the directory and its parents where they are missing.
void make_directory(const std::string& directory);
// Throws unless the file system of this directory has room for so many bytes.
void require_space(const std::string& directory, std::uint64_t bytes);
// Appends so many bytes of room to an existing file, or throws and leaves it as it was. A file whose format
// cannot be cut short is brought to its new size before it is changed, so that a full disk or a quota cannot
// harm what it holds.
void reserve_space(const std::string& path, std::uint64_t bytes);
// Waits until the file's data are on the disk.
void sync_file(const std::string& path);
// Puts the finished file `temporary` in the place of `path`, so that a reader or a crash sees the old or the
// new one.
void replace_file(const std::string& temporary, const std::string& path);
void write_text(const std::string& path, const std::string& text);  // through a temporary file
std::string read_text(const std::string& path);

}  // namespace freshet
