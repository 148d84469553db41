// The geometry of walls: straight segments and the points that stand for them, made once from polylines.
#pragma once
#include <array>
#include <vector>

#include "kernels/segment_bins.hpp"
#include "kernels/wall_kind.hpp"

namespace freshet {

using WallLine = std::vector<std::array<double, 2>>;  // m, the water on its left; closed if it ends where it begins

// A straight piece of wall; the water is on the left of a -> b. In 1-D a is the wall and normal[0] points to the water.
struct WallSegment {
  double a[2], b[2];     // m
  double tangent[2];     // unit
  double normal[2];      // unit, towards the water
  double length;         // m
  double before, after;  // m, how far beyond a and b its images still count: behind corners of less than 180 degrees
  double see_a, see_b;   // m, how far beyond a and b they are seen: free_end where the wall ends and an opening begins
  int next;              // the segment behind the corner of less than 180 degrees at b; -1 if there is none
};
constexpr double free_end = 1e300;  // m

struct WallPoint {
  double x[2];   // m
  double p[3];   // projector onto the directions that the wall reflects: xx, xy, yy
  double share;  // the wall that it stands for, in half spacings (about 1); rows: the area [m2] (1-D: m)
  int segment;
};

struct WallGeometry {
  std::vector<WallPoint> points;
  std::vector<WallSegment> segments;
  SegmentBins bins;  // of the segments
};

struct WallOptions {
  WallKind kind;
  double spacing;     // m, dx of the water: points lie dx/2 apart (rows: dx)
  double reach;       // m, how deep rows go behind the wall
  bool slip = true;   // false: the wall also mirrors the tangential velocity
};

// inside: a point of the water, which tells the side of a 1-D wall (there a line is one point).
WallGeometry lay_walls(int dimension, const std::vector<WallLine>& lines, const WallOptions& options,
                       const std::array<double, 2>& inside);

// Whether mirror images are exact for these polylines: every corner is a right one with the water inside.
bool only_right_corners(const std::vector<WallLine>& lines);

}  // namespace freshet
