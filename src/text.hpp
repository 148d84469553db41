// Numbers and names as text: for people, and for files that are read back.
#pragma once
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace freshet {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  // a result that there is not

[[gnu::format(printf, 1, 2)]] inline std::string formatted(const char* format, ...) {
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, values)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(values);
  return text;
}

// For people.
inline std::string brief(double value, int digits = 6) { return formatted("%.*g", digits, value); }

// A number of a table with so many decimals, in the given unit; "-" where it is not known.
inline std::string decimal(double value, double unit, int decimals) {
  return std::isfinite(value) ? formatted("%.*f", decimals, value / unit) : "-";
}
// The same in powers of ten.
inline std::string scientific(double value, int decimals) {
  return std::isfinite(value) ? formatted("%.*e", decimals, value) : "-";
}

// For people too: as many digits as the same number needs to be read back, six at least.
inline std::string shown(double value) {
  int digits = 6;
  while (digits < 17 && std::strtod(brief(value, digits).c_str(), nullptr) != value) ++digits;
  return brief(value, digits);
}

// For files: the shortest digits that read back to the same bits, the same on every machine.
inline std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

inline std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// A cell of a CSV row, quoted where it would break the row.
inline std::string csv_word(const std::string& plain) {
  if (plain.find_first_of(",\"\n") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) quoted += c == '"' ? "\"\"" : std::string(1, c == '\n' ? ' ' : c);
  return quoted + "\"";
}

}  // namespace freshet
