// freshet difference: two runs of one scene, particle by particle, from their state.h5. What two backends,
// compilers or numbers of threads make of a scene differs by round-off, and by how much it has grown. Reads
// every saved real field.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "src/errors.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/files.hpp"
#include "src/run/commands/commands.hpp"

namespace freshet {
namespace {

struct State {
  double t = 0;  // s
  FieldSet fields;
  std::map<int, int> place;  // of the particle with that id
};

State read_state(const std::string& directory) {
  const std::string path = path_in(directory, "state.h5");
  if (!std::filesystem::exists(path)) throw SceneError(path + " is not there: 'freshet run' writes it");
  State state;
  look_at_checkpoint(path, [&] { state.t = read_checkpoint(path).run.at("clock").at(0); });
  read_checkpoint_fields(path, state.fields);
  const auto id = on_host(state.fields.integer("id"));
  for (int i = 0; i < state.fields.size(); ++i) state.place.emplace(id(i), i);
  return state;
}

struct Difference {
  double size = 0, largest = 0, squares = 0;  // of the first run's values; of the differences
  int id = -1;                                // where the largest is

  void add(int one, double a, double b) {
    const double d = std::abs(a - b);
    size = std::max(size, std::abs(a));
    squares += d * d;
    if (d > largest || std::isnan(d)) largest = d, id = one;
  }
};

using Pairs = std::vector<std::pair<int, int>>;  // places in the first and in the second run

Pairs particles_of_both(const State& a, const State& b) {
  Pairs pairs;
  for (const auto& [id, place] : a.place) {
    const auto found = b.place.find(id);
    if (found != b.place.end()) pairs.emplace_back(place, found->second);
  }
  return pairs;
}

void print_row(const NamedField<double>& field, const State& a, const NamedField<double>& other,
               const Pairs& pairs) {
  const auto id = on_host(a.fields.integer("id"));
  const auto first = on_host(field.data), second = on_host(other.data);
  Difference difference;
  for (const auto& [i, j] : pairs) difference.add(id(i), first(i), second(j));
  std::printf("%-16s %-8s %12.5g %12.3g %12.3g", field.name.c_str(), field.unit.c_str(), difference.size,
              difference.largest,
              std::sqrt(difference.squares / std::max<double>(1, static_cast<double>(pairs.size()))));
  if (difference.id >= 0) std::printf(" %8d", difference.id);
  std::printf("\n");
}

void print_lonely(const NamedField<double>& field, const std::string& directory) {
  std::printf("%-16s %-8s only in %s\n", field.name.c_str(), field.unit.c_str(), directory.c_str());
}

}  // namespace

int difference_command(const Arguments& arguments, const Parts&) {
  if (arguments.words.size() != 2) throw SceneError("usage: freshet difference DIR DIR");
  const auto runtime = start_kokkos(1);
  const State a = read_state(arguments.words[0]), b = read_state(arguments.words[1]);
  const Pairs pairs = particles_of_both(a, b);
  std::printf("t = %.9g s and %.9g s; particles %d and %d, %zu in both\n", a.t, b.t, a.fields.size(),
              b.fields.size(), pairs.size());
  std::printf("%-16s %-8s %12s %12s %12s %8s\n", "field", "unit", "largest", "difference", "rms", "of id");
  for (const auto& field : a.fields.reals()) {
    if (const auto* other = b.fields.find_real(field.name)) print_row(field, a, *other, pairs);
    else print_lonely(field, arguments.words[0]);
  }
  for (const auto& field : b.fields.reals())
    if (!a.fields.find_real(field.name)) print_lonely(field, arguments.words[1]);
  return 0;
}

}  // namespace freshet
