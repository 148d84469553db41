// Words of the command line, sorted. Mistakes are SceneError (exit 2).
#pragma once
#include <map>
#include <string>
#include <vector>

namespace freshet {

struct Option {
  std::string name;  // "--out"
  bool takes_value;
};

struct Arguments {
  std::vector<std::string> words;      // neither options nor key=value
  std::vector<std::string> overrides;  // key=value
  std::map<std::string, std::string> options;

  bool has(const std::string& option) const { return options.count(option) > 0; }
  std::string value(const std::string& option, const std::string& otherwise) const;
  int number(const std::string& option, int otherwise, int least) const;
};

Arguments parse_arguments(const std::string& command, const std::vector<std::string>& words,
                          const std::vector<Option>& known);

}  // namespace freshet
