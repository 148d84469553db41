// Errors of meaning, collected so that one run of the reader shows them all: each with line, caret and help.
#pragma once
#include <string>
#include <vector>

namespace freshet::input {

// Where something stands: in the scene file or in a command-line override. Lines and columns count from 1.
struct Place {
  int source = 0;  // index returned by Diagnostics::add_source; 0 = the scene file
  int line = 1, column = 1;
};

// Who can mend it: decides between SceneError (exit 2) and DataError (exit 3).
enum class Blame { scene, data };

class Diagnostics {
 public:
  // `name` heads the messages; `located` tells whether line:col follows it (not for the command line).
  int add_source(std::string name, std::string text, bool located = true);

  void error(const Place& place, std::string message, std::string help = "", Blame blame = Blame::scene);
  bool any() const { return !entries_.empty(); }
  std::size_t count() const { return entries_.size(); }

  // Throws one SceneError or DataError with the whole text, in the order of the places, if anything was
  // reported.
  void throw_if_any() const;

  std::string name(int source) const { return sources_[source].name; }
  const std::string& text(int source) const { return sources_[source].text; }

 private:
  struct Source {
    std::string name, text;
    bool located;
  };
  struct Entry {
    Place place;
    std::string message, help;
    Blame blame;
  };
  std::string format(const Entry& entry) const;

  std::vector<Source> sources_;
  std::vector<Entry> entries_;
};

// "did you mean 'spacing'?" where a candidate is close to the word, else "".
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);
// The candidate within the fewest edits, at most a third of the word's letters (short words: one, but not
// all), else "". Swaps of neighbours count once; capitals and - against _ do not count.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);
// "1 row", "2 rows"
std::string counted(std::size_t count, const std::string& one);
// 'a', 'b' or 'c'
std::string listed(const std::vector<std::string>& words);

}  // namespace freshet::input
