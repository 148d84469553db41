// The points' fields, and the structs that kernels see them by.
#include "src/fpm/solver.hpp"

namespace freshet::fpm {

void FinitePointset::make_fields() {
  for (const char* name : {"x", "y"}) points_.real(name, "m", Carry::state);
  for (const char* name : {"u", "v", "u_old", "v_old"}) points_.real(name, "m/s", Carry::state);
  for (const char* name : {"p", "phi"}) points_.real(name, "Pa", Carry::state);
  points_.real("h", "m", Carry::state);
  if (grading_) points_.real("dx", "m", Carry::state);
  points_.integer("id", "1", Carry::state);
  PointKeeper::make_fields(points_);
  for (const char* name : {"u_star", "v_star"}) points_.real(name, "m/s", Carry::no);
  for (const char* name : {"normal_x", "normal_y"}) points_.real(name, "1", Carry::no);
  for (const char* name : {"q", "given"}) points_.real(name, "Pa", Carry::no);
  points_.real("source", "Pa/m2", Carry::no);
  points_.real("flux", "Pa/m", Carry::no);
  points_.integer("row", "1", Carry::no);
}

Flow FinitePointset::bind() const {
  const FieldSet& f = points_;
  return {f.vector<2>("x", "y"), f.vector<2>("u", "v"), f.vector<2>("u_old", "v_old"), f.real("p"), f.real("phi"), f.integer("kind"), f.integer("side"),
          f.integer("surface"), f.vector<2>("u_star", "v_star"), f.vector<2>("normal_x", "normal_y"), f.real("q"), f.real("source"),
          f.real("flux"), f.real("given"), f.integer("row"), f.size(), keeper_.expansion()};
}

}  // namespace freshet::fpm
