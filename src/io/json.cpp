#include "src/io/json.hpp"

#include <cstdio>

namespace freshet {

std::string JsonWriter::quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    char code[8];
    std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    if (c == '"' || c == '\\') quoted += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20) quoted += code;
    else quoted += c;
  }
  return quoted + "\"";
}

JsonWriter& JsonWriter::item(const std::string& key, const std::string& value) {
  if (!first_) text_ += ',';
  if (depth_ > 0) text_ += '\n' + std::string(2 * static_cast<std::size_t>(depth_), ' ');
  if (!key.empty()) text_ += quoted(key) + ": ";
  text_ += value;
  first_ = false;
  return *this;
}

JsonWriter& JsonWriter::open(const std::string& key, char bracket) {
  item(key, std::string(1, bracket));
  ++depth_;
  first_ = true;
  return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
  --depth_;
  if (!first_) text_ += '\n' + std::string(2 * static_cast<std::size_t>(depth_), ' ');
  text_ += bracket;
  first_ = false;
  return *this;
}

}  // namespace freshet
