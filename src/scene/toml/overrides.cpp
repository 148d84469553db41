#include "src/scene/toml/overrides.hpp"

#include <toml++/toml.h>

#include <optional>

namespace freshet::input {
namespace {

Place place_from(const toml::source_region& region, int source) {
  return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

// `bed.z=0.1*x` and `scene.name=trial` are not TOML: their value stands for a string. A value that begins
// like an array, table or string is taken at its word, so that its mistakes show.
std::string quoted_value(const std::string& text) {
  const std::size_t value = text.find_first_not_of(" \t", text.find('=') + 1);
  if (value == std::string::npos || std::string("[{\"'").find(text[value]) != std::string::npos) return "";
  std::string quoted = text.substr(0, value) + '"';
  for (const char c : text.substr(value))
    quoted += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string(1, c);
  return quoted + '"';
}

std::optional<toml::table> parse(const std::string& text, int source, Diagnostics& diagnostics) {
  const std::string path = std::to_string(source);
  try {
    return toml::parse(std::string_view(text), path);
  } catch (const toml::parse_error& error) {
    const std::string quoted = quoted_value(text);
    if (!quoted.empty()) {
      try {
        return toml::parse(std::string_view(quoted), path);
      } catch (const toml::parse_error&) {  // the key is at fault: the first message says so
      }
    }
    diagnostics.error(place_from(error.source(), source), std::string(error.description()));
    return std::nullopt;
  }
}

std::vector<std::string> names_of(const toml::array& tables) {
  std::vector<std::string> names;
  for (const toml::node& node : tables) {
    const toml::table* table = node.as_table();
    const auto name = table ? (*table)["name"].value<std::string>() : std::nullopt;
    if (name) names.push_back(*name);
  }
  return names;
}

toml::table* find_element(toml::array& tables, const std::string& label) {
  const bool index = label.size() < 7 && label.find_first_not_of("0123456789") == std::string::npos;
  if (index && std::stoul(label) < tables.size()) return tables[std::stoul(label)].as_table();
  for (toml::node& node : tables) {
    toml::table* table = node.as_table();
    if (table && (*table)["name"].value<std::string>() == label) return table;
  }
  return nullptr;
}

class Merger {
 public:
  Merger(int source, Diagnostics& diagnostics) : source_(source), diagnostics_(diagnostics) {}

  void into(toml::table& tree, toml::table& changes, const std::string& path) {
    for (auto&& [key, change] : changes) {
      const std::string here = path.empty() ? std::string(key.str()) : path + '.' + std::string(key.str());
      toml::node* old = tree.get(key.str());
      toml::table* branch = change.as_table();
      const bool deeper = branch && !branch->is_inline();
      if (deeper && old && old->is_table()) {
        into(*old->as_table(), *branch, here);
      } else if (deeper && old && old->is_array()) {
        into_elements(*old->as_array(), *branch, here);
      } else {
        change.visit([&tree, name = key](auto& value) { tree.insert_or_assign(name, std::move(value)); });
      }
    }
  }

 private:
  void into_elements(toml::array& tables, toml::table& changes, const std::string& path) {
    for (auto&& [key, change] : changes) {
      const std::string label(key.str());
      toml::table* element = find_element(tables, label);
      toml::table* branch = change.as_table();
      if (element && branch) {
        into(*element, *branch, path + '.' + label);
        continue;
      }
      const std::vector<std::string> names = names_of(tables);
      std::string help = did_you_mean(label, names);
      if (help.empty() && !names.empty())
        help = "there are " + listed(names) + ", or 0 to " + std::to_string(tables.size() - 1);
      if (help.empty()) help = "elements go by number, 0 to " + std::to_string(tables.size() - 1);
      const std::string what = element ? "a key must follow '" : "there is no '";
      diagnostics_.error(place_from(key.source(), source_), what + path + '.' + label + '\'', help);
    }
  }

  int source_;
  Diagnostics& diagnostics_;
};

}  // namespace

void apply_overrides(const std::vector<std::string>& overrides, toml::table& tree, Diagnostics& diagnostics) {
  for (const std::string& text : overrides) {
    const int source = diagnostics.add_source("command line", text, false);
    if (text.find('=') == std::string::npos) {
      diagnostics.error({source, 1, 1}, "'" + text + "' is not an override",
                        "write key=value, as in water.spacing=25");
      continue;
    }
    std::optional<toml::table> changes = parse(text, source, diagnostics);
    if (changes) Merger(source, diagnostics).into(tree, *changes, "");
  }
}

}  // namespace freshet::input
