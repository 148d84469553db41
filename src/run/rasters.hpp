// [raster]: maps in DIR/rasters as ESRI ASCII grids. QUANTITY_NNNN.asc at the times of times.csv; with maxima, looked at in
// every step: max_depth, max_speed, max_depth_speed, arrival, last_wet and front.csv. A scene without it: nothing at all.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/run/events.hpp"
#include "src/run/water_grid.hpp"

namespace freshet {

class RasterRecorder {
 public:
  RasterRecorder(const Scene& scene, const std::string& directory);

  void begin(const Method& method);             // a new run: the folder, the maxima of the start
  void record(const Method& method, double t);  // after a step
  void write(const Method& method, double t);   // the maps of a raster time
  void finish() const;                          // the maxima so far; also where a run is interrupted

  void save(Values& values) const;
  void restore(const Values& values);
  const Timetable& times() const { return times_; }

 private:
  std::string file(const std::string& name) const;
  void write_map(Rasters::Quantity quantity, const CoverFields& sums) const;
  void write_front() const;

  std::optional<Rasters> wanted_;
  std::string folder_;
  CellGrid grid_;
  Timetable times_, front_times_;
  std::vector<double> written_;     // s, times of the maps
  std::optional<Maxima> maxima_;
  std::vector<double> front_;       // rows of front.csv: t, area, x_low, x_high, y_low, y_high
  std::vector<double> bed_;         // m, at the centres; made when a surface is first written
};

}  // namespace freshet
