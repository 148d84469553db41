// A typed view of one TOML table. A section of the scene reads like its documentation:
//   water.number("spacing", "m").positive().required();
// Every key asked for is known; when the Table goes out of scope it reports the keys that nobody asked for,
// and those that are missing. Nothing throws here: errors collect in Diagnostics and reading goes on with a
// stand-in value.
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernels/choice.hpp"
#include "src/scene/read.hpp"
#include "src/scene/scene.hpp"
#include "src/scene/toml/diagnostics.hpp"
#include "src/scene/toml/toml_names.hpp"
#include "src/text.hpp"

namespace freshet::input {

// What all tables of one scene share.
struct Context {
  KeyNote* note(const std::string& path,
                const std::string& what);  // of a key, where `keys` are wanted; else null

  Diagnostics& diagnostics;
  std::filesystem::path directory;  // of the scene file: relative paths start here
  double gravity = 9.81;            // m/s2, the constant g of expressions
  // [compare] names an exact solution, with errors: no errors follow from its absence
  bool exact_failed = false;
  std::vector<std::string> notes;  // what the reader decided and the user may want to know
  // takes what the reader asks for, in its order, where somebody wants to know
  std::vector<KeyNote>* keys = nullptr;
};

using freshet::shown;
inline std::string rounded(double place) { return brief(place, 8); }

// A value as a scene would write it; "" where it cannot be said.
template <class T>
auto named_or_empty(const T& choice, int) -> decltype(name_of(choice)) {
  return '"' + name_of(choice) + '"';
}
template <class T>
std::string named_or_empty(const T&, long) {
  return "";
}
template <class T>
std::string written(const T& value) {
  if constexpr (std::is_same_v<T, bool>) return value ? "true" : "false";
  else if constexpr (std::is_arithmetic_v<T>) return shown(value);
  else if constexpr (std::is_same_v<T, std::string>) return '"' + value + '"';
  else return named_or_empty(value, 0);
}

// A key of a table, named or not.
struct Slot {
  Context* context;
  std::string path;  // "water.spacing"
  Place place;
  bool given;
  std::function<void()> report_missing;
};

// The value of a key: what it must satisfy, and what stands for it when it is absent.
template <class T>
class Value {
 public:
  Value(Slot slot, std::optional<T> value) : slot_(std::move(slot)), value_(std::move(value)) {}

  template <class Test>
  Value& check(Test holds, const std::string& rule, const std::string& help = "") {
    if (KeyNote* it = note()) it->rule += (it->rule.empty() ? "" : ", ") + rule;
    if (value_ && !holds(*value_))
      fail("'" + slot_.path + "' is " + shown(*value_) + "; it must be " + rule, help);
    return *this;
  }
  Value& positive() {
    return check([](T v) { return v > 0; }, "positive");
  }
  Value& at_least(T low) {
    return check([low](T v) { return v >= low; }, "at least " + shown(low));
  }
  Value& within(T low, T high) {
    return check([=](T v) { return v >= low && v <= high; }, "between " + shown(low) + " and " + shown(high));
  }

  // Reports an error at this value and drops it.
  void fail(const std::string& message, const std::string& help = "", Blame blame = Blame::scene) {
    slot_.context->diagnostics.error(slot_.place, message, help, blame);
    value_.reset();
  }

  T required(T stand_in = {}) {  // absent: error
    if (KeyNote* it = note()) it->standard = "required";
    if (!slot_.given) slot_.report_missing();
    return value_.value_or(std::move(stand_in));
  }
  T otherwise(T fallback) const {
    if (KeyNote* it = note()) it->standard = word_ ? word_(fallback) : written(fallback);
    return value_.value_or(std::move(fallback));
  }
  const std::optional<T>& optional() const { return value_; }
  bool given() const { return slot_.given; }  // named in the scene, though perhaps with an error
  Place place() const { return slot_.place; }
  KeyNote* note() const { return slot_.context->note(slot_.path, ""); }
  Value& worded(std::function<std::string(const T&)> word) {  // how the key's note says a value
    word_ = std::move(word);
    return *this;
  }

 private:
  Slot slot_;
  std::optional<T> value_;
  std::function<std::string(const T&)> word_;
};

extern template class Value<double>;  // table.cpp
extern template class Value<int>;

class Table {
 public:
  Table(Context& context, toml::table* table, std::string path, Place place);
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  ~Table();  // reports unknown and missing keys

  // Scalars. `unit` is only for messages.
  Value<double> number(const std::string& key, const std::string& unit = "");
  Value<int> integer(const std::string& key);
  Value<bool> boolean(const std::string& key);
  Value<std::string> text(const std::string& key);
  template <class E>
  Value<E> choice(const std::string& key, const std::vector<std::pair<std::string, E>>& choices);
  template <class E>  // an array of such words
  Value<std::vector<E>> choices(const std::string& key,
                                const std::vector<std::pair<std::string, E>>& choices);
  Value<std::vector<std::string>> words(const std::string& key, const std::vector<std::string>& known);

  // Shapes.
  Value<std::vector<double>> numbers(const std::string& key, const std::string& what = "numbers");
  Value<Point> point(const std::string& key, int dimension = 2);  // [x, y]; 1-D: x or [x]
  Value<std::vector<Point>> points(
      const std::string& key);                       // [[x, y], ...] or a file with a row x, y for each
  Value<Function> function(const std::string& key);  // a number or an expression in x and y
  Value<std::array<Function, 2>> velocity(const std::string& key, int dimension);
  Value<std::string> file(const std::string& key);  // absolute path of an existing file

  // Tables inside this one.
  Table table(const std::string& key);          // absent: a table without keys, given() is false
  std::size_t size_of(const std::string& key);  // of an array of tables, 0 if absent
  Table element(const std::string& key, std::size_t i);

  bool has(const std::string& key) const;
  void accept(const std::string& key) { find(key); }  // makes it known
  bool has_text(const std::string& key) const;
  bool has_number(const std::string& key) const;
  bool has_table(const std::string& key) const;
  // The one key of these that is named; two of them, or none where one is required, are an error and give "".
  std::string one_of(const std::vector<std::string>& keys, bool required);

  void accept_rest();  // makes every key known: after an error that leaves open which ones belong here

  bool given() const { return table_ != nullptr; }
  Place place() const { return place_; }
  Place place_of(const std::string& key) const;  // of the value; of the table where the key is absent
  Place key_place(const std::string& key) const;
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + '.' + key; }
  Context& context() const { return context_; }
  void error(const std::string& key, const std::string& message, const std::string& help = "",
             Blame blame = Blame::scene) const;

 private:
  toml::node* find(const std::string& key);  // makes the key known
  Slot slot(const std::string& key, const std::string& hint = "");
  template <class T>
  Value<T> value(const std::string& key, std::optional<T> found, const std::string& hint = "") {
    return Value<T>(slot(key, hint), std::move(found));
  }
  Value<std::vector<Point>> points_from_file(const std::string& key);
  void wrong_type(const std::string& key, const toml::node& node, const std::string& wanted) const;
  Place place_from(const toml::source_region& region) const;
  std::optional<Function> compiled(const toml::node& node, const std::string& path);
  Value<std::string> word(const std::string& key, const std::vector<std::string>& words);

  Context& context_;
  toml::table* table_;
  std::string path_;
  Place place_;
  std::vector<std::string> known_;
  struct Missing {
    std::string key, hint;
  };
  std::vector<Missing> missing_;
};

template <class E>
std::vector<std::string> words_of(const std::vector<std::pair<std::string, E>>& choices) {
  std::vector<std::string> words;
  for (const auto& choice : choices) words.push_back(choice.first);
  return words;
}

// The word that a choice goes by.
template <class E>
auto word_for(const E& choice, const std::vector<std::pair<std::string, E>>&, int)
    -> decltype(name_of(choice)) {
  return written(choice);
}
template <class E>
std::string word_for(const E& choice, const std::vector<std::pair<std::string, E>>& choices, long) {
  for (const auto& [word, value] : choices)
    if (value == choice) return written(word);
  return "";
}

template <class E>
E chosen(const std::string& word, const std::vector<std::pair<std::string, E>>& choices) {
  for (const auto& choice : choices)
    if (choice.first == word) return choice.second;
  return choices.front().second;
}

template <class E>
Value<E> Table::choice(const std::string& key, const std::vector<std::pair<std::string, E>>& choices) {
  const std::optional<std::string> found = word(key, words_of(choices)).optional();
  Value<E> it = value<E>(key, found ? std::optional<E>(chosen(*found, choices)) : std::nullopt,
                         listed(words_of(choices)));
  return it.worded([choices](const E& e) { return word_for(e, choices, 0); });
}

template <class E>
Value<std::vector<E>> Table::choices(const std::string& key,
                                     const std::vector<std::pair<std::string, E>>& choices) {
  const std::optional<std::vector<std::string>> found = words(key, words_of(choices)).optional();
  std::optional<std::vector<E>> all;
  if (found) all.emplace();
  if (found)
    for (const std::string& word : *found) all->push_back(chosen(word, choices));
  return value<std::vector<E>>(key, all, "an array of " + listed(words_of(choices)));
}

}  // namespace freshet::input
