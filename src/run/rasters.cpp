#include "src/run/rasters.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "cellgrid/assign.hpp"
#include "src/io/ascii_grid.hpp"
#include "src/io/files.hpp"
#include "src/io/number.hpp"
#include "src/io/summary.hpp"

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

}  // namespace

RasterRecorder::RasterRecorder(const Scene& scene, const std::string& directory)
    : wanted_(scene.rasters), folder_((std::filesystem::path(directory) / "rasters").string()) {
  if (!wanted_) return;
  grid_ = square_grid(scene.domain, wanted_->spacing);
  if (!wanted_->what.empty()) times_ = Timetable(regular_times(wanted_->every, scene.end_time));
  if (!wanted_->maxima) return;
  maxima_.emplace(grid_.size(), wanted_->arrival);
  front_times_ = Timetable(regular_times(scene.output.gauges_every > 0 ? scene.output.gauges_every : wanted_->every, scene.end_time));
}

std::string RasterRecorder::file(const std::string& name) const { return (std::filesystem::path(folder_) / name).string(); }

void RasterRecorder::begin(const Method& method) {
  if (!wanted_) return;
  make_directory(folder_);
  record(method, 0);
}

void RasterRecorder::record(const Method& method, double t) {
  if (!maxima_) return;
  const Front front = track_maxima(grid_, method, t, *maxima_);
  if (!front_times_.due(t)) return;
  while (front_times_.due(t)) front_times_.advance();
  for (const double value : {t, front.cells * grid_.dx * grid_.dy, front.x_low, front.x_high, front.y_low, front.y_high})
    front_.push_back(value);
}

void RasterRecorder::write(const Method& method, double t) {
  const CoverFields sums = cover_cells(grid_, method);
  for (const Quantity quantity : wanted_->what) {
    if (quantity == Quantity::surface && bed_.empty()) bed_ = bed_levels(grid_, method);
    write_map(quantity, sums);
  }
  written_.push_back(t);
  times_.advance();
  std::string rows = "map,t [s]\n";
  for (std::size_t k = 0; k < written_.size(); ++k) rows += std::to_string(k) + ',' + shortest(written_[k]) + '\n';
  write_text(file("times.csv"), rows);
}

void RasterRecorder::write_map(Quantity quantity, const CoverFields& sums) const {
  const auto cover = on_host(sums.cover), depth = on_host(sums.depth), u = on_host(sums.u), v = on_host(sums.v);
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
  char number[16];
  std::snprintf(number, sizeof number, "_%04zu.asc", written_.size());
  write_ascii_grid(file(name_of(quantity) + std::string(number)), grid_, value);
}

void RasterRecorder::finish() const {
  if (!maxima_) return;
  const auto arrival = copied(maxima_->arrival);
  for (const auto& [name, field] : named(*maxima_)) {
    const auto values = copied(field);
    write_ascii_grid(file(name + ".asc"), grid_, [&](std::size_t k) { return arrival[k] < 0 ? unknown : values[k]; });
  }
  write_front();
}

void RasterRecorder::write_front() const {
  std::string rows = "t [s],wet area [m2],x low [m],x high [m],y low [m],y high [m]\n";
  for (std::size_t k = 0; k < front_.size(); ++k) rows += shortest(front_[k]) + ((k + 1) % front_columns == 0 ? '\n' : ',');
  write_text(file("front.csv"), rows);
}

void RasterRecorder::save(Values& values) const {
  if (!wanted_) return;
  values["raster_times"] = written_;
  if (!maxima_) return;
  values["raster_front"] = front_;
  values["raster_front_times"] = {static_cast<double>(front_times_.done())};
  for (const auto& [name, field] : named(*maxima_)) values["raster_" + name] = copied(field);
}

void RasterRecorder::restore(const Values& values) {
  if (!wanted_) return;
  make_directory(folder_);
  written_ = values.at("raster_times");
  times_.skip_to(written_.size());
  if (!maxima_) return;
  front_ = values.at("raster_front");
  front_times_.skip_to(static_cast<std::size_t>(values.at("raster_front_times").at(0)));
  for (const auto& [name, field] : named(*maxima_)) upload(field, values.at("raster_" + name));
}

}  // namespace freshet
