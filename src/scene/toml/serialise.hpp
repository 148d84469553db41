// A TOML tree as text: sections and keys in the order of the source, numbers in their shortest exact form
// (toml++ writes 0.4 as 0.40000000000000002). Reading the text gives the same tree.
#pragma once
#include <string>

#include "src/scene/toml/toml_names.hpp"

namespace freshet::input {

std::string serialise(const toml::table& tree);

}  // namespace freshet::input
