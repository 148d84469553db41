// Reads a scene file (TOML, SI units) into a Scene. docs/reference/scene_keys.md lists the keys.
#pragma once
#include <string>
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet {

// Overrides are dotted paths, `water.spacing=25`, `gauge.ch5.at=[4.5, 1.2]`; they count as if they stood in
// the file. Data files are looked for beside the scene, then in $FRESHET_DATA, the checkout's data/ and
// ./data. Throws SceneError with every error of meaning in one text, each as file:line:col (or "command
// line") with the source line, a caret and help; of a syntax error the first. DataError if only data files
// are at fault.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

// The same for a text, such as Scene::text of a result. `file` heads the messages and its directory is
// searched for data.
Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides = {});

// What a key of a scene may be.
struct KeyNote {
  std::string path;  // "water.spacing"; of tables in arrays their name or number, "boundary.0.type"
  std::string what;  // "a number in m"
  std::string rule;  // "positive"
  // its default, as a scene would write it, "required", or "" where it is not one value
  std::string standard;
};

// Every key whose value the reader asked this scene for, named or not, in the order of reading. Of keys that
// exclude each other, and of those of a choice, that are the ones that the scene names.
std::vector<KeyNote> known_keys(const std::string& path, const std::vector<std::string>& overrides = {});

// What was understood, one line each: extent, bed, water, boundaries, stations, numerics, notes.
std::vector<std::string> describe(const Scene& scene);

}  // namespace freshet
