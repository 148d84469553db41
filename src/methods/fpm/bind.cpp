// The points' fields, and the structs that kernels see them by.
#include "src/methods/fpm/solver.hpp"

namespace freshet::fpm {

Flow FinitePointset::declare(const FieldList& fields) const {
  Flow flow;
  PointMarks marks;
  flow.declare(fields);
  marks.declare(fields);
  flow.kind = marks.kind, flow.side = marks.side, flow.surface = marks.surface;
  flow.points = points_.size();
  flow.expansion = keeper_.expansion();
  return flow;
}

void FinitePointset::make_fields() {
  declare(FieldList::making(points_));
  points_.real("h", "m", Carry::state);
  if (grading_) points_.real("dx", "m", Carry::state);
  points_.integer("id", "1", Carry::state);
}

Flow FinitePointset::bind() const { return declare(FieldList::binding(points_)); }

}  // namespace freshet::fpm
