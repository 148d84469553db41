#include "src/scene/read.hpp"

#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "src/errors.hpp"
#include "src/scene/sections/sections.hpp"
#include "src/scene/shapes/slope.hpp"
#include "src/scene/toml/overrides.hpp"
#include "src/scene/toml/serialise.hpp"

namespace freshet {
namespace {

using namespace input;

template <class Reader>
void read_each(Table& root, const std::string& key, Scene& scene, Reader reader) {
  const std::size_t count = root.size_of(key);
  for (std::size_t i = 0; i < count; ++i) {
    Table element = root.element(key, i);
    reader(element, scene);
  }
}

// As below, for method "fpm".
void read_fpm_sections(Table& root, Table& head, Scene& scene) {
  Table domain = root.table("domain"), water = root.table("water"), fluid = root.table("fluid"),
        fpm = root.table("fpm");
  Table time = root.table("time"), output = root.table("output"), limits = root.table("limits");
  scene.cfl = 0.15;                // of the support
  scene.limits.mass_error = 0.05;  // of the area: points come and go
  read_domain(domain, scene);
  if (scene.domain.dimension == 1)
    head.error("method", "method \"fpm\" needs two dimensions", "domain.box = [x0, y0, x1, y1]");
  read_spacing(water, scene);
  read_fluid(fluid, scene);
  read_fpm(fpm, scene);
  read_periodic(domain, scene);
  read_each(root, "wall", scene, read_wall);
  if (root.size_of("body") == 0)
    root.error("body", "the scene has no [[body]]: there is no water",
               "add [[body]] with a box, circle or polygon");
  read_each(root, "body", scene, read_body);
  read_each(root, "gauge", scene, read_gauge);
  read_time(time, {}, scene);
  read_output(output, scene);
  read_limits(limits, scene);
}

// The order in which sections need each other; the file may have them in any order.
void read_sections(Table& root, Scene& scene) {
  Table head = root.table("scene");
  read_scene_section(head, scene);
  if (scene.method == "fpm") return read_fpm_sections(root, head, scene);
  Table domain = root.table("domain"), sph = root.table("sph");
  Table water = root.table("water"), bed = root.table("bed"), compare = root.table("compare");
  Table sisph = root.table("sisph"), split = root.table("split"), merge = root.table("merge");
  Table time = root.table("time"), output = root.table("output"), limits = root.table("limits");
  Table raster = root.table("raster");
  read_domain(domain, scene);
  const bool acceleration_named = read_sph(sph, scene);
  read_sisph(sisph, scene);
  read_spacing(water, scene);
  read_bed(bed, scene);
  read_split(split, scene);
  read_merge(merge, scene);
  const ComparePlan plan = read_compare(compare, scene);
  // Exact solutions belong to the classical shallow-water equations; over a step the variational ones let too
  // little water pass.
  constexpr double step = 1.5;
  if (!acceleration_named && (scene.compare.exact || steepest_slope(scene) > step))
    scene.sph.acceleration = Acceleration::classical;
  read_water_state(water, scene);
  read_time(time, plan, scene);
  read_each(root, "boundary", scene, read_boundary);
  read_each(root, "wall", scene, read_wall);
  note_leaks(root, scene);
  check_formulation(sisph, scene);
  if (scene.sph.well_balanced && !scene.boundaries.empty())
    sph.error("well_balanced", "a well-balanced run needs a basin without open boundaries",
              "remove one of the two");
  read_each(root, "gauge", scene, read_gauge);
  read_each(root, "runup", scene, read_run_up);
  read_each(root, "profile", scene, read_transect);
  read_output(output, scene);
  read_rasters(raster, scene);
  read_limits(limits, scene);
}

toml::table parse(const std::string& text, Diagnostics& diagnostics) {
  try {
    return toml::parse(std::string_view(text), std::string("0"));
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    diagnostics.error(
        {0, static_cast<int>(at.line), static_cast<int>(at.column)}, std::string(error.description()),
        "a scene is TOML: each key once in a section, text in quotes, numbers without units, lists in [ ]");
  }
  return {};
}

// keys: takes the notes of the keys asked for, unless null.
Scene read_noting(const std::string& text, const std::string& file, const std::vector<std::string>& overrides,
                  std::vector<KeyNote>* keys) {
  Diagnostics diagnostics;
  diagnostics.add_source(file, text);
  toml::table tree = parse(text, diagnostics);
  diagnostics.throw_if_any();
  apply_overrides(overrides, tree, diagnostics);

  Scene scene;
  scene.file = file;
  scene.name = std::filesystem::path(file).stem().string();
  Context context{diagnostics, std::filesystem::absolute(file).parent_path(), scene.gravity, false, {}, keys};
  {
    Table root(context, &tree, "", Place{});
    read_sections(root, scene);
  }
  diagnostics.throw_if_any();
  scene.notes = std::move(context.notes);
  // A name taken from the file would change with the place that the text is read from.
  if (!tree.get_as<toml::table>("scene")) tree.insert_or_assign("scene", toml::table{});
  tree.get_as<toml::table>("scene")->insert("name", scene.name);
  scene.text = serialise(tree);
  return scene;
}

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in && text.empty()) throw SceneError(path + ": error: cannot read the scene file");
  return text;
}

}  // namespace

Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides) {
  return read_noting(text, file, overrides, nullptr);
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return read_scene_text(text_of(path), path, overrides);
}

std::vector<KeyNote> known_keys(const std::string& path, const std::vector<std::string>& overrides) {
  std::vector<KeyNote> keys;
  read_noting(text_of(path), path, overrides, &keys);
  return keys;
}

}  // namespace freshet
