// Numbers as text: what is read back, what people see, what is not known.
#include "src/text.hpp"

#include <catch2/catch.hpp>

using namespace freshet;

TEST_CASE("text: numbers for files read back to the same bits, with no digit too many") {
  for (const double value : {0.1, 1 / 3.0, 1e22, -2.5e-300, 123456789.123}) {
    CHECK(std::strtod(shortest(value).c_str(), nullptr) == value);
    CHECK(std::strtod(shown(value).c_str(), nullptr) == value);
  }
  CHECK(shortest(0.1) == "0.1");
  CHECK(shown(0.1) == "0.1");
  CHECK(shown(1200) == "1200");
  CHECK(shown(0.1 + 0.2) == "0.30000000000000004");
}

TEST_CASE("text: numbers for people are short, and what is not known is a dash") {
  CHECK(brief(1 / 3.0) == "0.333333");
  CHECK(brief(4512345.678, 9) == "4512345.68");
  CHECK(decimal(0.0123, 1e-3, 2) == "12.30");
  CHECK(decimal(unknown, 1, 2) == "-");
  CHECK(scientific(0.0123, 1) == "1.2e-02");
  CHECK(scientific(unknown, 1) == "-");
}

TEST_CASE("text: no line is too long") {
  const std::string word(5000, 'x');
  CHECK(formatted("%s %d", word.c_str(), 7) == word + " 7");
  CHECK(joined({"a", "b", "c"}, ", ") == "a, b, c");
  CHECK(joined({}, ", ").empty());
}
