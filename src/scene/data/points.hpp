// Bed levels from x-y-z points in any order of rows.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "src/scene/data/raster.hpp"
#include "src/scene/scene.hpp"

namespace freshet::input {

struct SurveyPoint {
  double x, y, z;  // m
};

// Three columns per line: comma, semicolon, tab or blank separated; one header line and # comments are
// skipped; z may be nan. Throws BadData with file:line.
std::vector<SurveyPoint> read_points(const std::string& path, const std::string& text);

// The lattice that the points form, x or y running fast; nodes that no point names are NaN. Empty where the
// points are not on a lattice with at least half of its nodes given.
std::optional<Raster> as_lattice(const std::vector<SurveyPoint>& points);

// Inverse-distance mean (power 2) of the 8 nearest points. Call it from one thread at a time.
Function nearest_points(std::vector<SurveyPoint> points);

// Mean distance of points spread evenly over their bounding box, m.
double mean_spacing(const std::vector<SurveyPoint>& points);

}  // namespace freshet::input
