#include "src/io/fluid.hpp"

namespace freshet {

std::vector<int> fluid_indices(const FieldSet& fields) {
  std::vector<int> indices;
  indices.reserve(static_cast<std::size_t>(fields.size()));
  // Wall points of a method without depths are water like any other.
  const auto* kind = fields.has("depth") ? fields.find_integer("kind") : nullptr;
  decltype(on_host(Field<int>())) kinds;
  if (kind) kinds = on_host(kind->data);
  for (int i = 0; i < fields.size(); ++i) {
    if (!kind || kinds(i) == 0) indices.push_back(i);
  }
  return indices;
}

Fluid fluid_on_host(const FieldSet& fields) {
  const auto indices = fluid_indices(fields);
  const auto real = [&](const char* name) { return gather(fields.find_real(name), indices); };
  return {real("x"),     real("y"),    real("u"), real("v"),
          real("depth"), real("mass"), real("h"), gather(fields.find_integer("id"), indices)};
}

int fluid_count(const FieldSet& fields) { return static_cast<int>(fluid_indices(fields).size()); }

}  // namespace freshet
