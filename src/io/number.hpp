// Numbers as text that reads back to the same bits: the shortest such digits, the same on every machine.
#pragma once
#include <charconv>
#include <string>

namespace freshet {

inline std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

}  // namespace freshet
