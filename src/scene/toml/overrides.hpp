// Command-line overrides: dotted paths with TOML values, `water.spacing=25`, `gauge.ch5.at=[1, 2]`,
// `scene.name=trial`.
#pragma once
#include <string>
#include <vector>

#include "src/scene/toml/diagnostics.hpp"
#include "src/scene/toml/toml_names.hpp"

namespace freshet::input {

// Puts the overrides into the tree, in their order. Elements of an array of tables go by index (from 0) or by
// name; words that are not TOML become strings; { } replaces a table, a dotted path changes one key of it.
// Each override is a source of `diagnostics`, so that later errors about its key and value point at the
// command line.
void apply_overrides(const std::vector<std::string>& overrides, toml::table& tree, Diagnostics& diagnostics);

}  // namespace freshet::input
