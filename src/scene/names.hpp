// The words for choices: what a scene may write, and what the program shows.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet {

template <class E>
using Names = std::vector<std::pair<std::string, E>>;

const Names<KernelName>& kernel_names();
const Names<Walling>& walling_names();
const Names<Sisph::Momentum>& momentum_names();
const Names<Sisph::Formulation>& formulation_names();
const Names<Sisph::Paths>& path_names();
const Names<Sisph::Correction>& correction_names();
const Names<Sisph::Coefficients>& coefficient_names();
std::string name_of(Stabilisation stabilisation);  // "Lax-Friedrichs with MUSCL"

template <class E>
std::string name_in(const Names<E>& names, E wanted) {
  for (const auto& [name, value] : names)
    if (value == wanted) return name;
  return "";
}

}  // namespace freshet
