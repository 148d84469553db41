#include "tests/support/points/cloud.hpp"

namespace freshet::test {

FieldSet point_fields(int dimension, const std::vector<Point>& points, std::vector<int> ids) {
  if (ids.empty()) ids = numbers(static_cast<int>(points.size()));
  FieldSet f(static_cast<int>(points.size()));
  const auto x = f.real("x", "m", Carry::sort), h = f.real("h", "m", Carry::sort);
  const auto y = dimension == 2 ? f.real("y", "m", Carry::sort) : Field<double>();
  const auto id = f.integer("id", "1", Carry::sort);
  for (std::size_t i = 0; i < points.size(); ++i) {
    x(i) = points[i][0];
    if (dimension == 2) y(i) = points[i][1];
    id(i) = ids[i];
  }
  return f;
}

template class Cloud<1>;
template class Cloud<2>;

}  // namespace freshet::test
