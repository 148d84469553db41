#include "src/run/record/rasters.hpp"

#include <cmath>

#include "cellgrid/parallel/assign.hpp"
#include "src/io/ascii_grid.hpp"

namespace freshet {
namespace {

using Quantity = Rasters::Quantity;
constexpr std::size_t front_columns = 6;

const char* name_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::depth: return "depth";
    case Quantity::surface: return "surface";
    case Quantity::u: return "u";
    case Quantity::v: return "v";
    case Quantity::speed: return "speed";
  }
  return "";
}

std::vector<double> copied(const Field<double>& field) {
  const auto host = on_host(field);
  return {host.data(), host.data() + host.extent(0)};
}

std::vector<std::pair<std::string, Field<double>>> named(const Maxima& maxima) {
  return {{"max_depth", maxima.depth},
          {"max_speed", maxima.speed},
          {"max_depth_speed", maxima.depth_speed},
          {"arrival", maxima.arrival},
          {"last_wet", maxima.last_wet}};
}

// The bed at the cells' centres, as the method feels it.
std::vector<double> bed_levels(const CellGrid& grid, const Method& method) {
  std::vector<Point> centres;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) centres.push_back({grid.x(i), grid.y(j)});
  std::vector<double> levels;
  for (const PointState& state : method.sample(centres)) levels.push_back(state.bed);
  return levels;
}

std::vector<double> map_times(const Rasters& wanted, double end) {
  return wanted.what.empty() ? std::vector<double>() : regular_times(wanted.every, end);
}

}  // namespace

RasterRecorder::RasterRecorder(const Scene& scene, const std::string& directory)
    : Observer(map_times(*scene.rasters, scene.end_time)), wanted_(*scene.rasters),
      folder_(path_in(directory, "rasters")), grid_(square_grid(scene.domain, wanted_.spacing)) {
  if (!wanted_.maxima) return;
  maxima_.emplace(grid_.size(), wanted_.arrival);
  front_times_ = Timetable(regular_times(
      scene.output.gauges_every > 0 ? scene.output.gauges_every : wanted_.every, scene.end_time));
}

void RasterRecorder::begin(const Method& method) {
  make_directory(folder_);
  after_step(method, {});
}

void RasterRecorder::after_step(const Method& method, const Clock& clock) {
  if (!maxima_) return;
  const Front front = track_maxima(grid_, method, clock.t, *maxima_);
  if (!front_times_.due(clock.t)) return;
  front_times_.skip_past(clock.t);
  for (const double value :
       {clock.t, front.cells * grid_.dx * grid_.dy, front.x_low, front.x_high, front.y_low, front.y_high})
    front_.push_back(value);
}

void RasterRecorder::take(const Method& method, const Clock& clock) {
  const TimedRegion region("run::output");
  const CoverFields sums = cover_cells(grid_, method);
  for (const Quantity quantity : wanted_.what) {
    if (quantity == Quantity::surface && bed_.empty()) bed_ = bed_levels(grid_, method);
    write_map(quantity, sums);
  }
  written_.push_back(clock.t);
  std::string rows = "map,t [s]\n";
  for (std::size_t k = 0; k < written_.size(); ++k)
    rows += std::to_string(k) + ',' + shortest(written_[k]) + '\n';
  write_text(file("times.csv"), rows);
}

void RasterRecorder::write_map(Quantity quantity, const CoverFields& sums) const {
  const auto cover = on_host(sums.cover), depth = on_host(sums.depth), u = on_host(sums.u),
             v = on_host(sums.v);
  const auto value = [&](std::size_t k) {
    if (cover(k) < edge_cover) return unknown;
    switch (quantity) {
      case Quantity::depth: return depth(k) / cover(k);
      case Quantity::surface: return depth(k) / cover(k) + bed_[k];
      case Quantity::u: return u(k) / cover(k);
      case Quantity::v: return v(k) / cover(k);
      case Quantity::speed: return std::hypot(u(k), v(k)) / cover(k);
    }
    return unknown;
  };
  write_ascii_grid(file(formatted("%s_%04zu.asc", name_of(quantity), written_.size())), grid_, value);
}

void RasterRecorder::finish(const Method&, const Clock&) {
  if (!maxima_) return;
  const auto arrival = copied(maxima_->arrival);
  for (const auto& [name, field] : named(*maxima_)) {
    const auto values = copied(field);
    write_ascii_grid(file(name + ".asc"), grid_,
                     [&](std::size_t k) { return arrival[k] < 0 ? unknown : values[k]; });
  }
  write_front();
}

void RasterRecorder::write_front() const {
  std::string rows = "t [s],wet area [m2],x low [m],x high [m],y low [m],y high [m]\n";
  for (std::size_t k = 0; k < front_.size(); ++k)
    rows += shortest(front_[k]) + ((k + 1) % front_columns == 0 ? '\n' : ',');
  write_text(file("front.csv"), rows);
}

void RasterRecorder::save(Values& values) const {
  values["raster_times"] = written_;
  if (!maxima_) return;
  values["raster_front"] = front_;
  for (const auto& [name, field] : named(*maxima_)) values["raster_" + name] = copied(field);
}

void RasterRecorder::restore(const Values& values, const Clock& clock) {
  make_directory(folder_);
  written_ = values.at("raster_times");
  if (!maxima_) return;
  front_ = values.at("raster_front");
  front_times_.skip_past(clock.t);
  for (const auto& [name, field] : named(*maxima_)) upload(field, values.at("raster_" + name));
}

}  // namespace freshet
