// particles.h5part of every method: each field that its scene may ask for is there.
#include <catch2/catch.hpp>

#include <set>

#include "src/io/hdf5.hpp"
#include "src/methods/method.hpp"
#include "src/run/record/particles.hpp"
#include "tests/support/run/scene_files.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

namespace {

// What the reader offers where a name is unknown: the words in quotes behind "wanted:".
std::vector<std::string> offered(const std::string& scene) {
  const std::string text = test::failure(scene + "[output]\nfields = [\"none\"]\n").text;
  const std::size_t begin = text.find("wanted: ");
  REQUIRE(begin != std::string::npos);
  std::vector<std::string> names;
  for (std::size_t at = text.find('\'', begin); at < text.find('\n', begin); at = text.find('\'', at)) {
    const std::size_t end = text.find('\'', at + 1);
    names.push_back(text.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return names;
}

std::string small_scene(const std::string& method, int dimension) {
  const std::string head = "[scene]\nmethod = \"" + method + "\"\n[time]\nend = 1\n[domain]\nbox = ";
  if (method == "fpm")
    return head + "[0, 0, 1, 1]\n[water]\nspacing = 0.1\n[[body]]\nbox = [0, 0, 1, 0.5]\n" +
           "[[wall]]\nline = [[0, 1], [0, 0], [1, 0], [1, 1]]\n";
  return head + (dimension == 1 ? "[0, 2]" : "[0, 0, 2, 1]") + "\n[water]\ndepth = 1\nspacing = 0.1\n";
}

}  // namespace

TEST_CASE("particle files: of every method all fields that its scenes may name can be written") {
  const auto [method, dimension] = GENERATE(
      table<std::string, int>({{"sph-swe", 1}, {"sph-swe", 2}, {"sisph", 1}, {"sisph", 2}, {"fpm", 2}}));
  CAPTURE(method, dimension);
  const std::string text = small_scene(method, dimension);
  const std::vector<std::string> names = offered(text);
  REQUIRE(names.size() >= 6);
  std::string list;
  std::set<std::string> expected{"x", "y", "id"};
  for (const std::string& name : names) {
    list += (list.empty() ? "\"" : ", \"") + name + '"';
    expected.insert(name == "u" ? "v_0" : name == "v" ? "v_1" : name);
  }
  const Scene scene = test::read_text(text + "[output]\nfields = [" + list + "]\n");
  const test::Scratch scratch;
  const auto of_scene = make_method(scene);
  ParticleRecorder recorder(scene, scratch.path());
  recorder.begin(*of_scene);
  recorder.take(*of_scene, {});
  const auto file = hdf5::File::look(scratch / "particles.h5part");
  const auto found = file.open("Step#0").names();
  CHECK(std::set<std::string>(found.begin(), found.end()) == expected);
}
