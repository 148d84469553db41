// Closed walls as a region: where water may be.
#pragma once
#include <vector>

#include "kernels/boundaries/walls/piece_bins.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

// The side of every closed wall on which the water is (left of its direction). Without closed walls:
// everywhere.
class WaterRegion {
 public:
  explicit WaterRegion(const std::vector<Wall>& walls);
  bool everywhere() const { return outlines_.empty(); }
  bool holds(const Point& p) const;

 private:
  struct Outline {
    std::vector<Point> line;
    bool water_inside;
    Box bounds;        // m
    PieceBins by_y{};  // its sides by their heights alone: those that a ray along x may cross

    bool encloses(const Point& p) const;
  };
  std::vector<Outline> outlines_;
};

}  // namespace freshet
