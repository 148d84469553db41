// Writes JSON objects and arrays with two blanks of indent, in the order of the calls. Numbers read back to
// the same bits; what is not finite becomes null.
#pragma once
#include <cmath>
#include <string>

#include "src/text.hpp"

namespace freshet {

class JsonWriter {
 public:
  // depth > 0: of members that another writer takes over.
  explicit JsonWriter(int depth = 0) : depth_(depth) {}

  JsonWriter& begin(const std::string& key = "") { return open(key, '{'); }
  JsonWriter& end() { return close('}'); }
  JsonWriter& array(const std::string& key = "") { return open(key, '['); }
  JsonWriter& end_array() { return close(']'); }
  JsonWriter& value(const std::string& key, double number) {
    return item(key, std::isfinite(number) ? shortest(number) : "null");
  }
  JsonWriter& value(const std::string& key, long number) { return item(key, std::to_string(number)); }
  JsonWriter& value(const std::string& key, int number) { return item(key, std::to_string(number)); }
  JsonWriter& value(const std::string& key, const std::string& text) { return item(key, quoted(text)); }

  // Text of the right depth.
  JsonWriter& members(const std::string& text) {
    text_ += (first_ ? "" : ",") + text;
    first_ = false;
    return *this;
  }

  const std::string& text() const { return text_; }
  static std::string quoted(const std::string& text);

 private:
  JsonWriter& item(const std::string& key, const std::string& value);
  JsonWriter& open(const std::string& key, char bracket);
  JsonWriter& close(char bracket);

  std::string text_;
  int depth_;
  bool first_ = true;  // in the innermost object or array
};

}  // namespace freshet
