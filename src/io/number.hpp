// Cells of CSV files. Numbers as text that reads back to the same bits: the shortest such digits, the same on every machine.
#pragma once
#include <charconv>
#include <string>

namespace freshet {

inline std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

// A cell of a CSV row, quoted where it would break the row.
inline std::string csv_word(const std::string& plain) {
  if (plain.find_first_of(",\"\n") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) quoted += c == '"' ? "\"\"" : std::string(1, c == '\n' ? ' ' : c);
  return quoted + "\"";
}

}  // namespace freshet
