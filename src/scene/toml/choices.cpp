#include "src/scene/toml/choices.hpp"

namespace freshet::input {

void KeyReader::pair(const std::string& key, const std::array<std::string, 2>& names, double& first,
                     double& second) {
  const std::string both = '[' + names[0] + ", " + names[1] + ']';
  Value<std::vector<double>> given = table_.numbers(key, "two numbers: " + both);
  if (!given.optional()) return;
  const std::vector<double>& numbers = *given.optional();
  if (numbers.size() != 2 || numbers[0] < 0 || numbers[1] < 0)
    return given.fail("'" + table_.path_of(key) + "' must be " + both + " with neither below 0");
  first = numbers[0], second = numbers[1];
}

void KeyText::factor(const std::string&, double& value) {
  if (value != 1) text += " x " + shown(value);
}

void KeyText::pair(const std::string&, const std::array<std::string, 2>& names, double& first,
                   double& second) {
  text += ' ' + names[0] + " = " + shown(first) + ", " + names[1] + " = " + shown(second);
}

}  // namespace freshet::input
