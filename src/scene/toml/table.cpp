// The structure of a table: places, known and missing keys, tables inside. Typed values are in values.cpp.
#include "src/scene/toml/table.hpp"

#include <toml++/toml.h>

#include <algorithm>

namespace freshet::input {

KeyNote* Context::note(const std::string& path, const std::string& what) {
  if (!keys) return nullptr;
  auto known = std::find_if(keys->begin(), keys->end(), [&](const KeyNote& k) { return k.path == path; });
  if (known == keys->end()) known = keys->insert(known, {path, what, "", ""});
  if (!what.empty()) known->what = what, known->rule.clear();
  return &*known;
}

template class Value<double>;
template class Value<int>;

Table::Table(Context& context, toml::table* table, std::string path, Place place)
    : context_(context), table_(table), path_(std::move(path)), place_(place) {}

Table::~Table() {
  if (table_) {
    for (const auto& entry : *table_) {
      const std::string key(entry.first.str());
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      const std::string meant = nearest(key, known_);
      const std::string help = meant.empty() ? "known here: " + listed(known_) : did_you_mean(key, known_);
      context_.diagnostics.error(key_place(key), "unknown key '" + path_of(key) + "'", help);
      // The key that was misspelt is not missing as well.
      const auto is_meant = [&](const Missing& missing) { return missing.key == meant; };
      missing_.erase(std::remove_if(missing_.begin(), missing_.end(), is_meant), missing_.end());
    }
  }
  for (const Missing& missing : missing_) {
    const std::string where = path_.empty() ? "" : " under [" + path_ + "]";
    const std::string what = missing.hint.empty() ? "" : " (" + missing.hint + ")";
    context_.diagnostics.error(place_, "'" + path_of(missing.key) + "' is missing",
                               "add '" + missing.key + "'" + what + where);
  }
}

Place Table::place_from(const toml::source_region& region) const {
  if (!region.begin || !region.path) return place_;  // made by the parser, not written by the user
  return {std::stoi(*region.path), static_cast<int>(region.begin.line),
          static_cast<int>(region.begin.column)};
}

bool Table::has(const std::string& key) const { return table_ && table_->contains(key); }
bool Table::has_text(const std::string& key) const { return has(key) && table_->get(key)->is_string(); }
bool Table::has_number(const std::string& key) const { return has(key) && table_->get(key)->is_number(); }
bool Table::has_table(const std::string& key) const { return has(key) && table_->get(key)->is_table(); }

Place Table::place_of(const std::string& key) const {
  return has(key) ? place_from(table_->get(key)->source()) : place_;
}

Place Table::key_place(const std::string& key) const {
  if (!has(key)) return place_;
  return place_from(table_->find(key)->first.source());
}

void Table::error(const std::string& key, const std::string& message, const std::string& help,
                  Blame blame) const {
  context_.diagnostics.error(place_of(key), message, help, blame);
}

toml::node* Table::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return has(key) ? table_->get(key) : nullptr;
}

Slot Table::slot(const std::string& key, const std::string& hint) {
  context_.note(path_of(key), hint);
  return {&context_, path_of(key), place_of(key), has(key), [this, key, hint] {
            missing_.push_back({key, hint});
          }};
}

Table Table::table(const std::string& key) {
  toml::node* node = find(key);
  if (node && !node->is_table()) wrong_type(key, *node, "a table");
  return Table(context_, node ? node->as_table() : nullptr, path_of(key), place_of(key));
}

std::size_t Table::size_of(const std::string& key) {
  toml::node* node = find(key);
  if (!node) return 0;
  if (node->is_array() && node->as_array()->is_homogeneous(toml::node_type::table))
    return node->as_array()->size();
  if (node->is_array() && node->as_array()->empty()) return 0;
  if (node->is_table() && place_of(key).source > 0) {
    error(key, "the scene has no [[" + path_of(key) + "]] to change");
    return 0;
  }
  wrong_type(key, *node, "an array of tables, [[" + path_of(key) + "]]");
  return 0;
}

Table Table::element(const std::string& key, std::size_t i) {
  toml::table& element = *(*find(key)->as_array())[i].as_table();
  const auto name = element["name"].value<std::string>();
  const std::string label = name ? *name : std::to_string(i);
  return Table(context_, &element, path_of(key) + '.' + label, place_from(element.source()));
}

void Table::accept_rest() {
  if (!table_) return;
  for (const auto& entry : *table_) known_.emplace_back(entry.first.str());
}

std::string Table::one_of(const std::vector<std::string>& keys, bool required) {
  std::string named;
  for (const std::string& key : keys) {
    find(key);
    if (!has(key)) continue;
    if (!named.empty()) {
      context_.diagnostics.error(key_place(key),
                                 "'" + path_of(named) + "' and '" + path_of(key) + "' exclude each other",
                                 "keep one of them");
      return "";
    }
    named = key;
  }
  if (named.empty() && required) {
    context_.diagnostics.error(
        place_, "one of " + listed(keys) + " is missing" + (path_.empty() ? "" : " under [" + path_ + "]"));
  }
  return named;
}

}  // namespace freshet::input
