// The sections of method "fpm": [fluid], [[body]], [fpm], and domain.periodic.
#include <cmath>

#include "kernels/boundaries/walls/polyline.hpp"
#include "src/scene/sections/sections.hpp"
#include "src/scene/toml/choices.hpp"

namespace freshet::input {
namespace {

Point vector_or(Table& section, const std::string& key, const std::string& what, const Point& otherwise) {
  Value<std::vector<double>> numbers = section.numbers(key, what);
  if (!numbers.optional()) return otherwise;
  if (numbers.optional()->size() != 2) {
    numbers.fail("'" + section.path_of(key) + "' has " + std::to_string(numbers.optional()->size()) +
                 " numbers; it needs two: " + what);
    return otherwise;
  }
  return {(*numbers.optional())[0], (*numbers.optional())[1]};
}

void read_box(Table& section, Body& body) {
  Value<std::vector<double>> box = section.numbers("box", "numbers in m: x0, y0, x1, y1");
  const std::vector<double> b = box.optional().value_or(std::vector<double>{0, 0, 1, 1});
  if (b.size() != 4 || !(b[0] < b[2]) || !(b[1] < b[3])) {
    box.fail("'body.box' must be [x0, y0, x1, y1] with the low corner first");
    return;
  }
  body.outline = {{b[0], b[1]}, {b[2], b[1]}, {b[2], b[3]}, {b[0], b[3]}};
  body.lattice = true;
}

void read_circle(Table& section, Body& body) {
  Table circle = section.table("circle");
  body.centre = circle.point("at", 2).required();
  body.radius = circle.number("radius", "m").positive().required(1);
}

void read_polygon(Table& section, Body& body) {
  Value<std::vector<Point>> corners = section.points("polygon");
  if (!corners.optional()) return;
  body.outline = *corners.optional();
  if (body.outline.size() > 1 && body.outline.front() == body.outline.back()) body.outline.pop_back();
  if (body.outline.size() < 3) corners.fail("'body.polygon' needs at least 3 corners");
  else if (signed_area(body.outline) < 0) body.outline = {body.outline.rbegin(), body.outline.rend()};
}

}  // namespace

void read_fluid(Table& section, Scene& scene) {
  Fpm& fpm = scene.fpm.emplace();
  fpm.density = section.number("density", "kg/m3").positive().otherwise(fpm.density);
  fpm.viscosity = section.number("viscosity", "m2/s").at_least(0).otherwise(fpm.viscosity);
  fpm.force = vector_or(section, "force", "the acceleration in m/s2, [fx, fy]", {0, -scene.gravity});
}

void read_fpm(Table& section, Scene& scene) {
  Fpm& fpm = *scene.fpm;
  fpm.support = section.number("support").within(2.2, 6).otherwise(fpm.support);
  fpm.hole = section.number("hole").within(0.75, 1.25).otherwise(fpm.hole);
  if (const auto grading = section.function("grading").optional()) fpm.grading = *grading;
  fpm.by_neighbours = section.choice<bool>("support_by", {{"spacing", false}, {"neighbours", true}})
                          .otherwise(fpm.by_neighbours);
  fpm.scheme = section.choice("scheme", named(fpm::pressure_schemes())).otherwise(fpm.scheme);
  fpm.implicit_viscosity = section.choice<bool>("diffusion", {{"explicit", false}, {"implicit", true}})
                               .otherwise(fpm.implicit_viscosity);
  fpm.slip =
      section.choice<bool>("walls", {{"slip", true}, {"no-slip", false}}).otherwise(fpm.viscosity == 0);
  fpm.tolerance = section.number("tolerance").within(1e-14, 1e-2).otherwise(fpm.tolerance);
}

void read_periodic(Table& domain, Scene& scene) {
  const auto axes = domain.choices<int>("periodic", {{"x", 0}, {"y", 1}}).optional();
  if (axes)
    for (const int axis : *axes) scene.fpm->periodic[static_cast<std::size_t>(axis)] = true;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double length = scene.domain.high[axis] - scene.domain.low[axis],
                 least = (scene.fpm->grading ? 10 : 2.5) * (scene.fpm->by_neighbours ? 1.5 : 1) *
                         scene.fpm->support * scene.water.spacing;
    if (scene.fpm->periodic[axis] && length < least)
      domain.error("periodic",
                   "the domain is " + shown(length) +
                       " m long; a periodic one needs 2.5 of the longest supports, " + shown(least) + " m",
                   "a smaller water.spacing");
  }
}

void read_body(Table& section, Scene& scene) {
  Body body;
  const std::string source = section.one_of({"box", "circle", "polygon"}, true);
  if (source == "box") read_box(section, body);
  if (source == "circle") read_circle(section, body);
  if (source == "polygon") read_polygon(section, body);
  const auto velocity = section.velocity("velocity", 2).optional();
  if (velocity) body.velocity = *velocity;
  if (body.outline.size() > 2 || body.radius > 0) scene.fpm->bodies.push_back(body);
}

}  // namespace freshet::input
