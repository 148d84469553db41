// A choice that a scene makes is a variant of structs, each of which carries its `name`, the word by which a
// scene asks for it, what it does, and keys(k), which names the keys of its own to whoever visits them (the
// reader, the read-back): see kernels/swe/force/stabilisation.hpp. A struct without keys of its own needs no
// keys(k). Where choices differ in a few values alone, it is one of a list of rows with a `name`:
// kernels/fpm/pressure/pressure_scheme.hpp.
#pragma once
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace freshet {

template <class... Each>
std::string name_of(const std::variant<Each...>& choice) {
  return std::visit([](const auto& c) { return c.name; }, choice);
}
template <class Row>
auto name_of(const Row& choice) -> decltype(std::string(choice.name)) {
  return choice.name;
}

template <class... Each>
std::vector<std::variant<Each...>> all_of_kind(const std::variant<Each...>*) {
  return {Each{}...};
}

// Every alternative with its defaults, in the order of the variant.
template <class Choice>
std::vector<Choice> alternatives() {
  return all_of_kind(static_cast<const Choice*>(nullptr));
}

template <class Each, class Keys>
auto visit_keys(Each& choice, Keys& keys, int) -> decltype(choice.keys(keys)) {
  choice.keys(keys);
}
template <class Each, class Keys>
void visit_keys(Each&, Keys&, long) {}

// Tells `keys` every key of the alternative that `choice` holds.
template <class Choice, class Keys>
void visit_keys(Choice& choice, Keys& keys) {
  static_assert(!std::is_const_v<Choice>,
                "keys(k) of a constant choice cannot be called, and would be passed over");
  std::visit([&](auto& c) { visit_keys(c, keys, 0); }, choice);
}

}  // namespace freshet
