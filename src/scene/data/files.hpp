// Finding and opening the data files that a scene names.
#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace freshet::input {

// A data file that cannot be used; the message names the file and, where there is one, the line.
struct BadData : std::runtime_error {
  explicit BadData(const std::string& message, std::string help_text = "")
      : std::runtime_error(message), help(std::move(help_text)) {}
  std::string help;
};

struct FoundFile {
  std::string path;    // absolute; empty = not found
  std::string looked;  // "looked in ...": for the message
};
// Relative names are tried from the scene's directory, then $FRESHET_DATA, the checkout's data/ and ./data.
FoundFile find_file(const std::string& name, const std::filesystem::path& scene_directory);

// The whole file without byte order mark and carriage returns. Throws BadData: unreadable, compressed,
// GeoTIFF, NetCDF.
std::string read_text(const std::string& path);

// Calls visit(line number, line) for each line, numbered from 1.
template <class Visit>
void for_each_line(const std::string& text, Visit visit) {
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) end = text.size();
    visit(++number, text.substr(begin, end - begin));
    begin = end + 1;
  }
}

// The cells of a line: separated by semicolons, else commas, else tabs, else runs of blanks; trailing
// separators add no cell.
std::vector<std::string> split_cells(const std::string& line);
// True if the whole cell is one finite number.
bool parse_number(const std::string& cell, double& number);

std::string file_name(const std::string& path);          // for messages: the last part
std::string at_line(const std::string& path, int line);  // "wave.txt:7"
bool is_comment_or_empty(const std::string& line);       // starts with # or has only blanks

}  // namespace freshet::input
