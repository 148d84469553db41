// [raster]: maps in DIR/rasters as ESRI ASCII grids. QUANTITY_NNNN.asc at the times of times.csv; with
// maxima, looked at in every step: max_depth, max_speed, max_depth_speed, arrival, last_wet and front.csv.
#pragma once
#include <optional>

#include "src/io/files.hpp"
#include "src/run/observe/observer.hpp"
#include "src/run/record/water_grid.hpp"

namespace freshet {

class RasterRecorder : public Observer {
 public:
  static bool wanted(const Scene& scene) { return scene.rasters.has_value(); }
  static std::vector<std::string> files() { return {"rasters"}; }
  RasterRecorder(const Scene& scene, const std::string& directory);

  void begin(const Method& method) override;                           // the folder, the maxima of the start
  void after_step(const Method& method, const Clock& clock) override;  // maxima
  void take(const Method& method, const Clock& clock) override;        // the maps of a raster time
  void finish(const Method& method, const Clock& clock) override;      // the maxima so far
  void save(Values& values) const override;
  void restore(const Values& values, const Clock& clock) override;

 private:
  std::string file(const std::string& name) const { return path_in(folder_, name); }
  void write_map(Rasters::Quantity quantity, const CoverFields& sums) const;
  void write_front() const;

  Rasters wanted_;
  std::string folder_;
  CellGrid grid_;
  Timetable front_times_;
  std::vector<double> written_;  // s, times of the maps
  std::optional<Maxima> maxima_;
  std::vector<double> front_;  // rows of front.csv: t, area, x_low, x_high, y_low, y_high
  std::vector<double> bed_;    // m, at the centres; made when a surface is first written
};

}  // namespace freshet
