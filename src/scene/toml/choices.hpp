// How a scene's choices (kernels/choice.hpp) are read and read back: their names, and the keys that each has
// of its own.
#pragma once
#include <algorithm>
#include <array>

#include "kernels/choice.hpp"
#include "src/scene/toml/diagnostics.hpp"
#include "src/scene/toml/table.hpp"

namespace freshet::input {

// Names and values, for Table::choice; of those with the same name the first.
template <class Choice>
std::vector<std::pair<std::string, Choice>> named(const std::vector<Choice>& choices) {
  std::vector<std::pair<std::string, Choice>> all;
  for (const Choice& choice : choices)
    if (std::none_of(all.begin(), all.end(),
                     [&](const auto& known) { return known.first == name_of(choice); }))
      all.emplace_back(name_of(choice), choice);
  return all;
}

template <class Choice>
std::vector<std::pair<std::string, Choice>> named() {
  return named(alternatives<Choice>());
}

// Reads the keys of a choice from a table.
class KeyReader {
 public:
  explicit KeyReader(Table& table) : table_(table) {}
  void factor(const std::string& key, double& value) {
    value = table_.number(key).at_least(0).otherwise(value);
  }
  void pair(const std::string& key, const std::array<std::string, 2>& names, double& first, double& second);

 private:
  Table& table_;
};

// The names of the keys of a choice.
struct KeyNames {
  std::vector<std::string> names;
  void factor(const std::string& key, double&) { names.push_back(key); }
  void pair(const std::string& key, const std::array<std::string, 2>&, double&, double&) {
    names.push_back(key);
  }
  void word(const std::string& key, const std::array<std::string, 2>&, bool&) { names.push_back(key); }
  void level() { names.insert(names.end(), {"level", "series"}); }
  void in_time(const std::string& key, const std::string&) { names.push_back(key); }
  void one_in_time(const std::array<std::string, 2>& keys, const std::string&, bool&) {
    names.insert(names.end(), keys.begin(), keys.end());
  }
  void if_given(const std::string& key, const std::string&, bool&) { names.push_back(key); }
};

// A choice's keys as text, as it follows the title: " a = 1, b = 0", " x 0.5"; nothing for a factor of 1, nor
// for what follows time.
struct KeyText {
  std::string text;
  void factor(const std::string&, double& value);
  void pair(const std::string&, const std::array<std::string, 2>& names, double& first, double& second);
  void word(const std::string&, const std::array<std::string, 2>& words, bool& second) {
    text += " by " + words[second ? 1 : 0];
  }
  void level() {}
  void in_time(const std::string&, const std::string&) {}
  void one_in_time(const std::array<std::string, 2>&, const std::string&, bool&) {}
  void if_given(const std::string&, const std::string&, bool&) {}
};

// What the program shows of a choice: its title and keys.
template <class Choice>
std::string titled(Choice choice) {
  KeyText keys;
  visit_keys(choice, keys);
  return std::visit([](const auto& c) { return c.title; }, choice) + keys.text;
}

template <class Choice>
std::vector<std::string> keys_of(Choice choice) {
  KeyNames keys;
  visit_keys(choice, keys);
  return keys.names;
}

// Those of `choices` that have the key, as "'lax-friedrichs' or 'two-shock'".
template <class Choice, class Has>
std::string owners(Has has) {
  std::vector<std::string> names;
  for (const Choice& choice : alternatives<Choice>())
    if (has(choice) && std::count(names.begin(), names.end(), name_of(choice)) == 0)
      names.push_back(name_of(choice));
  return listed(names);
}

template <class Choice>
bool has_key(const Choice& choice, const std::string& key) {
  const std::vector<std::string> keys = keys_of(choice);
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// An error at `foreign`, a key that goes with those choices alone for which has(choice) holds.
template <class Choice, class Has>
void reject(Table& table, const std::string& key, const Choice& choice, const std::string& foreign, Has has) {
  table.accept(foreign);
  table.error(foreign,
              "'" + table.path_of(foreign) + "' belongs to " + owners<Choice>(has) + ", and '" +
                  table.path_of(key) + "' is '" + name_of(choice) + "'",
              "remove it, or use " + owners<Choice>(has));
}

// Makes the keys of every alternative known: where nobody knows which one is meant.
template <class Choice>
void accept_keys(Table& table) {
  for (const Choice& choice : alternatives<Choice>())
    for (const std::string& key : keys_of(choice)) table.accept(key);
}

// The keys that `choice`, the value of `key`, has are read; those that only others have are errors.
template <class Choice, class Reader>
void read_keys(Table& table, const std::string& key, Choice& choice, Reader reader) {
  visit_keys(choice, reader);
  std::vector<std::string> seen = keys_of(choice);
  for (const Choice& other : alternatives<Choice>())
    for (const std::string& foreign : keys_of(other)) {
      if (std::find(seen.begin(), seen.end(), foreign) != seen.end()) continue;
      seen.push_back(foreign);
      if (table.has(foreign))
        reject(table, key, choice, foreign, [&](const Choice& c) { return has_key(c, foreign); });
    }
}

}  // namespace freshet::input
