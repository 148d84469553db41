// Closed walls as a region: where water may be.
#pragma once
#include <vector>

#include "kernels/segment_bins.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

double signed_area(const std::vector<Point>& line);                       // m2, positive counter-clockwise; closed or not
double distance(const Point& p, const Point& a, const Point& b);          // m, to the segment a-b
bool crosses_itself(const std::vector<Point>& line);                      // closed or not

// The side of every closed wall on which the water is (left of its direction). Without closed walls: everywhere.
class WaterRegion {
 public:
  explicit WaterRegion(const std::vector<Wall>& walls);
  bool everywhere() const { return outlines_.empty(); }
  bool holds(const Point& p) const;

 private:
  struct Outline {
    std::vector<Point> line;
    bool water_inside;
    Point low, high;     // m, bounds
    SegmentBins by_y{};  // its sides by their heights alone: those that a ray along x may cross

    bool encloses(const Point& p) const;
  };
  std::vector<Outline> outlines_;
};

}  // namespace freshet
