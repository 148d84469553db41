#include "src/run/commands/arguments.hpp"

#include <algorithm>
#include <charconv>

#include "src/errors.hpp"
#include "src/scene/toml/diagnostics.hpp"

namespace freshet {
namespace {

const Option& find_option(const std::string& command, const std::string& name,
                          const std::vector<Option>& known) {
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const Option& o) { return o.name == name; });
  if (found != known.end()) return *found;
  std::vector<std::string> names;
  for (const auto& option : known) names.push_back(option.name);
  const std::string hint = input::did_you_mean(name, names);
  throw SceneError(
      "freshet " + command + ": unknown option " + name + (hint.empty() ? "" : ": " + hint) +
      (names.empty() ? "\n  help: it takes no options" : "\n  help: it takes " + input::listed(names)));
}

}  // namespace

std::string Arguments::value(const std::string& option, const std::string& otherwise) const {
  const auto found = options.find(option);
  return found == options.end() ? otherwise : found->second;
}

int Arguments::number(const std::string& option, int otherwise, int least) const {
  const auto found = options.find(option);
  if (found == options.end()) return otherwise;
  const std::string& text = found->second;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < least) {
    throw SceneError(option + " needs a whole number of at least " + std::to_string(least) + ", not '" +
                     text + "'");
  }
  return number;
}

Arguments parse_arguments(const std::string& command, const std::vector<std::string>& words,
                          const std::vector<Option>& known) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto equals = word.find('=');
    if (word.rfind("--", 0) == 0) {
      const Option& option = find_option(command, word.substr(0, equals), known);
      if (!option.takes_value && equals != std::string::npos)
        throw SceneError(option.name + " takes no value");
      if (option.takes_value && equals == std::string::npos && i + 1 == words.size()) {
        throw SceneError(option.name + " needs a value");
      }
      const bool next = option.takes_value && equals == std::string::npos;
      arguments.options[option.name] = next                          ? words[++i]
                                       : equals == std::string::npos ? ""
                                                                     : word.substr(equals + 1);
    } else if (equals != std::string::npos && equals > 0 && !arguments.words.empty()) {
      arguments.overrides.push_back(word);
    } else {
      arguments.words.push_back(word);
    }
  }
  return arguments;
}

}  // namespace freshet
