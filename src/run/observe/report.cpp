#include "src/run/observe/report.hpp"

#include <algorithm>

namespace freshet {

JsonWriter& Report::member(const std::string& key) {
  const auto found =
      std::find_if(members_.begin(), members_.end(), [&](const Member& member) { return member.key == key; });
  return found != members_.end() ? found->value : members_.emplace_back(Member{key}).value;
}

std::string Report::members() const {
  std::string text;
  for (auto [key, value] : members_) {
    if (key == "warnings") {
      value.array(key);
      for (const auto& warning : warnings) value.value("", warning);
      value.end_array();
    } else if (value.text().empty()) {
      value.begin(key).end();
    }
    text += (text.empty() ? "" : ",") + value.text();
  }
  return text;
}

}  // namespace freshet
