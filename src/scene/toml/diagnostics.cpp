#include "src/scene/toml/diagnostics.hpp"

#include <algorithm>
#include <cctype>
#include <tuple>

#include "src/errors.hpp"

namespace freshet::input {
namespace {

std::string line_of(const std::string& text, int line) {
  std::size_t begin = 0;
  for (int i = 1; i < line && begin != std::string::npos; ++i) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (begin == std::string::npos) return "";
  std::string found = text.substr(begin, text.find('\n', begin) - begin);
  if (!found.empty() && found.back() == '\r') found.pop_back();
  return found;
}

// Blanks up to the column; tabs stay tabs and a multi-byte character is one column, so that the caret lines
// up.
std::string indent_to(const std::string& line, int column) {
  std::string indent;
  int at = 1;
  for (std::size_t i = 0; i < line.size() && at < column; ++i) {
    if ((static_cast<unsigned char>(line[i]) & 0xC0) == 0x80) continue;
    indent += line[i] == '\t' ? '\t' : ' ';
    ++at;
  }
  indent.append(std::max(0, column - at), ' ');
  return indent;
}

// Optimal string alignment: insertions, deletions, replacements and swaps of neighbours cost 1 each.
int edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

std::string plain(std::string word) {
  for (char& c : word) c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

}  // namespace

int Diagnostics::add_source(std::string name, std::string text, bool located) {
  sources_.push_back({std::move(name), std::move(text), located});
  return static_cast<int>(sources_.size()) - 1;
}

void Diagnostics::error(const Place& place, std::string message, std::string help, Blame blame) {
  entries_.push_back({place, std::move(message), std::move(help), blame});
}

std::string Diagnostics::format(const Entry& entry) const {
  const Source& source = sources_[entry.place.source];
  std::string out = source.name;
  if (source.located)
    out += ':' + std::to_string(entry.place.line) + ':' + std::to_string(entry.place.column);
  out += ": error: " + entry.message + '\n';
  const std::string line = line_of(source.text, entry.place.line);
  if (!line.empty()) out += "  " + line + "\n  " + indent_to(line, entry.place.column) + "^\n";
  if (!entry.help.empty()) out += "  help: " + entry.help + '\n';
  return out;
}

void Diagnostics::throw_if_any() const {
  if (entries_.empty()) return;
  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.place.source, a.place.line, a.place.column) <
           std::tie(b.place.source, b.place.line, b.place.column);
  });
  std::string text;
  for (const Entry& entry : sorted) text += (text.empty() ? "" : "\n") + format(entry);
  text.pop_back();  // the last newline: whoever prints the message adds one
  const auto of_data = [](const Entry& entry) { return entry.blame == Blame::data; };
  if (std::all_of(sorted.begin(), sorted.end(), of_data)) throw DataError(text);
  throw SceneError(text);
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  const int length = static_cast<int>(word.size());
  const int limit = std::min(std::max(1, length / 3), length - 1);
  int least = 2 * limit + 2;
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(plain(word), plain(candidate));
    // first letters break ties
    const int rank = 2 * distance + (plain(word)[0] == plain(candidate)[0] ? 0 : 1);
    if (distance <= limit && rank < least) {
      least = rank;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? "" : "did you mean '" + best + "'?";
}

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + ' ' + one + (count == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? " or " : ", ";
    out += '\'' + words[i] + '\'';
  }
  return out;
}

}  // namespace freshet::input
