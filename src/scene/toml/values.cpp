// The typed values of a table.
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "src/scene/data/files.hpp"
#include "src/scene/toml/expression.hpp"
#include "src/scene/toml/table.hpp"

namespace freshet::input {
namespace {

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "an array";
    case toml::node_type::string: return "a string";
    case toml::node_type::integer: return "an integer";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "a boolean";
    default: return "a date or time";
  }
}

std::optional<double> finite_number(const toml::node& node) {
  if (!node.is_number()) return std::nullopt;
  const std::optional<double> number = node.value<double>();
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<Point> as_point(const toml::node& node) {
  const toml::array* pair = node.as_array();
  if (!pair || pair->size() != 2) return std::nullopt;
  const auto x = finite_number((*pair)[0]), y = finite_number((*pair)[1]);
  return x && y ? std::optional<Point>(Point{*x, *y}) : std::nullopt;
}

bool reads_as_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

}  // namespace

void Table::wrong_type(const std::string& key, const toml::node& node, const std::string& wanted) const {
  const auto text = node.value<std::string>();
  const std::string help =
      node.is_string() && text && reads_as_number(*text) ? "remove the quotes around the number" : "";
  error(key, "'" + path_of(key) + "' must be " + wanted + ", not " + type_name(node), help);
}

Value<double> Table::number(const std::string& key, const std::string& unit) {
  const toml::node* node = find(key);
  std::optional<double> found;
  if (node) found = finite_number(*node);
  if (node && !found) wrong_type(key, *node, "a number");
  return value(key, found, unit.empty() ? "a number" : "a number in " + unit);
}

Value<int> Table::integer(const std::string& key) {
  const toml::node* node = find(key);
  std::optional<int> found;
  if (node && node->is_integer()) found = node->value<int>();
  if (node && !found) wrong_type(key, *node, "a whole number");
  return value(key, found, "a whole number");
}

Value<bool> Table::boolean(const std::string& key) {
  const toml::node* node = find(key);
  std::optional<bool> found;
  if (node && node->is_boolean()) found = node->value<bool>();
  if (node && !found) wrong_type(key, *node, "true or false");
  return value(key, found, "true or false");
}

Value<std::string> Table::text(const std::string& key) {
  const toml::node* node = find(key);
  std::optional<std::string> found;
  if (node && node->is_string()) found = node->value<std::string>();
  if (node && !found) wrong_type(key, *node, "a string");
  return value(key, found, "a string");
}

Value<std::string> Table::word(const std::string& key, const std::vector<std::string>& words) {
  Value<std::string> found = text(key);
  if (!found.optional()) return found;
  const std::string given = *found.optional();
  if (std::find(words.begin(), words.end(), given) == words.end()) {
    const std::string rule = words.size() == 1 ? "" : "one of ";
    found.fail("'" + path_of(key) + "' is '" + given + "'; it must be " + rule + listed(words),
               did_you_mean(given, words));
  }
  return found;
}

Value<std::vector<std::string>> Table::words(const std::string& key, const std::vector<std::string>& known) {
  const toml::node* node = find(key);
  std::optional<std::vector<std::string>> found;
  if (node && !node->is_array()) wrong_type(key, *node, "an array of " + listed(known));
  if (!node || !node->is_array()) return value(key, found, "an array of " + listed(known));
  found.emplace();
  for (const toml::node& element : *node->as_array()) {
    const auto word = element.value<std::string>();
    if (word && std::find(known.begin(), known.end(), *word) != known.end()) {
      found->push_back(*word);
      continue;
    }
    const std::string given = word ? "'" + *word + "'" : type_name(element);
    context_.diagnostics.error(place_from(element.source()),
                               "'" + path_of(key) + "' holds " + given + "; wanted: " + listed(known),
                               word ? did_you_mean(*word, known) : "");
  }
  return value(key, found);
}

Value<std::vector<double>> Table::numbers(const std::string& key, const std::string& what) {
  const toml::node* node = find(key);
  std::optional<std::vector<double>> found;
  if (node && node->is_array()) {
    found.emplace();
    for (const toml::node& element : *node->as_array()) {
      const auto number = finite_number(element);
      if (!number) {
        found.reset();
        break;
      }
      found->push_back(*number);
    }
  }
  if (node && !found) wrong_type(key, *node, "an array of " + what);
  return value(key, found, "an array of " + what);
}

Value<Point> Table::point(const std::string& key, int dimension) {
  const toml::node* node = find(key);
  const std::string wanted = dimension == 1 ? "a number (x, in m)" : "two numbers, [x, y] in m";
  std::optional<Point> found;
  if (node && dimension == 2) found = as_point(*node);
  if (node && dimension == 1) {
    const toml::array* array = node->as_array();
    const auto x = finite_number(array && array->size() == 1 ? (*array)[0] : *node);
    if (x) found = Point{*x, 0};
  }
  if (node && !found) wrong_type(key, *node, wanted);
  return value(key, found, wanted);
}

Value<std::vector<Point>> Table::points_from_file(const std::string& key) {
  Value<std::string> path = file(key);
  if (!path.optional()) return value<std::vector<Point>>(key, std::nullopt);
  std::vector<Point> points;
  try {
    for_each_line(read_text(*path.optional()), [&](int number, const std::string& line) {
      if (is_comment_or_empty(line)) return;
      const std::vector<std::string> cells = split_cells(line);
      Point p;
      if (cells.size() >= 2 && parse_number(cells[0], p[0]) && parse_number(cells[1], p[1]))
        points.push_back(p);
      else if (!points.empty() || number > 1)
        throw BadData(at_line(*path.optional(), number) + ": this is not a point, x and y in m");
    });
  } catch (const BadData& bad) {
    path.fail(bad.what(), bad.help, Blame::data);
    return value<std::vector<Point>>(key, std::nullopt);
  }
  return value<std::vector<Point>>(key, points);
}

Value<std::vector<Point>> Table::points(const std::string& key) {
  if (has_text(key)) return points_from_file(key);
  const toml::node* node = find(key);
  const std::string wanted = "an array of points, [[x, y], ...] in m, or the name of a file of them";
  std::optional<std::vector<Point>> found;
  if (node && node->is_array()) {
    found.emplace();
    for (const toml::node& element : *node->as_array()) {
      const auto point = as_point(element);
      if (!point) {
        context_.diagnostics.error(place_from(element.source()),
                                   "'" + path_of(key) + "' must be " + wanted + "; this is not a point");
        found.reset();
        break;
      }
      found->push_back(*point);
    }
  } else if (node) {
    wrong_type(key, *node, wanted);
  }
  return value(key, found, wanted);
}

std::optional<Function> Table::compiled(const toml::node& node, const std::string& path) {
  if (const auto number = finite_number(node)) {
    return Function([z = *number](double, double) { return z; });
  }
  const Place place = place_from(node.source());
  const auto text = node.value<std::string>();
  if (!node.is_string() || !text) {
    context_.diagnostics.error(
        place, "'" + path + "' must be a number or an expression in x and y, not " + type_name(node));
    return std::nullopt;
  }
  try {
    return compile_expression(*text, context_.gravity);
  } catch (const ExpressionError& error) {
    const Place inside = place_in_string(context_.diagnostics.text(place.source), place, error.position);
    context_.diagnostics.error(inside, "in '" + path + "': " + error.message, error.help);
    return std::nullopt;
  }
}

Value<Function> Table::function(const std::string& key) {
  const toml::node* node = find(key);
  std::optional<Function> found;
  if (node) found = compiled(*node, path_of(key));
  return value(key, found, "a number or an expression in x and y");
}

Value<std::array<Function, 2>> Table::velocity(const std::string& key, int dimension) {
  const toml::node* node = find(key);
  const toml::array* array = node ? node->as_array() : nullptr;
  std::optional<std::array<Function, 2>> found;
  if (array && array->size() == static_cast<std::size_t>(dimension)) {
    found.emplace();
    for (std::size_t i = 0; i < array->size(); ++i) {
      const auto component = compiled((*array)[i], path_of(key));
      if (component) (*found)[i] = *component;
    }
  } else if (node) {
    wrong_type(key, *node,
               dimension == 2 ? "two numbers or expressions, [u, v] in m/s"
                              : "one number or expression, [u] in m/s");
  }
  return value(key, found);
}

Value<std::string> Table::file(const std::string& key) {
  Value<std::string> name = text(key);
  if (!name.optional()) return name;
  const FoundFile found = find_file(*name.optional(), context_.directory);
  if (found.path.empty()) {
    name.fail("cannot find the file '" + *name.optional() + "'", found.looked, Blame::data);
    return name;
  }
  *table_->get(key)->as_string() = found.path;  // so that the scene's text can be read again from anywhere
  return value<std::string>(key, found.path);
}

}  // namespace freshet::input
