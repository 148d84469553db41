// The pieces of walls and the points that stand for them, made once from polylines.
#pragma once
#include "kernels/boundaries/walls/piece_bins.hpp"
#include "kernels/boundaries/walls/wall_kind.hpp"

namespace freshet {

struct WallPiece : Piece {
  // m, how far beyond a and b its images count: behind corners of less than 180 degrees
  double beyond_a = 0, beyond_b = 0;
};

struct WallPoint {
  double x[2];   // m
  double p[3];   // projector onto the directions that the wall reflects: xx, xy, yy
  double share;  // the wall that it stands for, in half spacings (about 1); rows: the area [m2] (1-D: m)
  int piece;
};

struct WallGeometry {
  std::vector<WallPoint> points;
  std::vector<WallPiece> pieces;
  PieceBins bins;
};

struct WallOptions {
  WallKind kind;
  double spacing;    // m, dx of the water: points lie dx/2 apart (rows: dx)
  double reach;      // m, how deep rows go behind the wall
  bool slip = true;  // false: the wall also mirrors the tangential velocity
};

// Lines with the water on their left. inside: a point of the water, which tells the side of a 1-D wall.
WallGeometry lay_walls(int dimension, const std::vector<Polyline>& lines, const WallOptions& options,
                       const Point& inside);

// Whether mirror images are exact for these polylines: every corner is a right one with the water inside.
bool only_right_corners(const std::vector<Polyline>& lines);

}  // namespace freshet
