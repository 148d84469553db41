// What there is to say of a run at its end, put together by its observers.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "src/io/json.hpp"
#include "src/text.hpp"

namespace freshet {

class Report {
 public:
  std::string tables;                 // for the terminal
  std::string balance;                // likewise, behind the line about the run as a whole
  std::vector<std::string> warnings;  // what the run noticed about itself

  // A member of summary.json, begun: the caller ends it.
  JsonWriter& object(const std::string& key) { return member(key).begin(key); }
  JsonWriter& array(const std::string& key) { return member(key).array(key); }
  // All members, the warnings too.
  std::string members() const;

 private:
  struct Member {
    std::string key;
    JsonWriter value{1};
  };
  JsonWriter& member(const std::string& key);

  // These are promised of every run, in this order: empty where a scene has none.
  std::deque<Member> members_{{"mass"},   {"energy"}, {"momentum"}, {"warnings"},
                              {"gauges"}, {"runup"},  {"waterline"}};
};

}  // namespace freshet
