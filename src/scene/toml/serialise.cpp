#include "src/scene/toml/serialise.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <sstream>
#include <tuple>
#include <vector>

#include "src/scene/toml/table.hpp"

namespace freshet::input {
namespace {

struct TableEntry {
  const toml::key* key;
  const toml::node* node;
};

// Keys of the file by their place; those of the command line, and those without a place, after them.
std::vector<TableEntry> in_order(const toml::table& table) {
  std::vector<TableEntry> entries;
  for (auto&& [key, node] : table) entries.push_back({&key, &node});
  const auto place = [](const TableEntry& entry) {
    const toml::source_region& source = entry.key->source();
    const std::string path = source.path ? *source.path : "~";
    return std::make_tuple(path.size(), path, source.begin.line, source.begin.column);
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const TableEntry& a, const TableEntry& b) { return place(a) < place(b); });
  return entries;
}

std::string written(const toml::key& key) {
  const std::string word(key.str());
  const bool bare = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  std::ostringstream out;
  if (bare) out << word;
  else out << toml::value<std::string>(word);
  return out.str();
}

std::string written(double number) {
  const std::string text = shown(number);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string inline_form(const toml::node& node);

std::string inline_form(const toml::array& array) {
  std::string out;
  for (const toml::node& element : array) out += (out.empty() ? "" : ", ") + inline_form(element);
  return '[' + out + ']';
}

std::string inline_form(const toml::table& table) {
  std::string out;
  for (const TableEntry& entry : in_order(table)) {
    out += (out.empty() ? "" : ", ") + written(*entry.key) + " = " + inline_form(*entry.node);
  }
  return out.empty() ? "{}" : "{ " + out + " }";
}

std::string inline_form(const toml::node& node) {
  if (const toml::array* array = node.as_array()) return inline_form(*array);
  if (const toml::table* table = node.as_table()) return inline_form(*table);
  if (const auto* number = node.as_floating_point()) return written(number->get());
  std::ostringstream out;
  node.visit([&out](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) out << value;
  });
  return out.str();
}

bool is_section(const toml::node& node) { return node.is_table() && !node.as_table()->is_inline(); }

bool is_section_list(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array && !array->empty() && array->is_homogeneous(toml::node_type::table) &&
         is_section(*array->get(0));
}

void write_section(std::ostream& out, const toml::table& table, const std::string& path) {
  const std::vector<TableEntry> entries = in_order(table);
  for (const TableEntry& entry : entries) {
    if (is_section(*entry.node) || is_section_list(*entry.node)) continue;
    out << written(*entry.key) << " = " << inline_form(*entry.node) << '\n';
  }
  for (const TableEntry& entry : entries) {
    const std::string here = path.empty() ? written(*entry.key) : path + '.' + written(*entry.key);
    if (is_section(*entry.node)) {
      out << "\n[" << here << "]\n";
      write_section(out, *entry.node->as_table(), here);
    } else if (is_section_list(*entry.node)) {
      for (const toml::node& element : *entry.node->as_array()) {
        out << "\n[[" << here << "]]\n";
        write_section(out, *element.as_table(), here);
      }
    }
  }
}

}  // namespace

std::string serialise(const toml::table& tree) {
  std::ostringstream out;
  write_section(out, tree, "");
  const std::string text = out.str();
  return text.substr(std::min(text.find_first_not_of('\n'), text.size()));
}

}  // namespace freshet::input
