#include "src/scene/data/points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "src/scene/data/files.hpp"

namespace freshet::input {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t neighbours = 8;

// The lattice along one axis, if the coordinates are equally spaced within 2 % of the step (they come
// rounded).
struct EvenAxis {
  double first = 0, step = 0;
  int count = 0;
};

std::optional<EvenAxis> find_axis(std::vector<double> coordinates) {
  std::sort(coordinates.begin(), coordinates.end());
  const double same = 1e-7 * (coordinates.back() - coordinates.front());
  std::vector<double> distinct;
  for (const double c : coordinates) {
    if (distinct.empty() || c - distinct.back() > same) distinct.push_back(c);
  }
  if (distinct.size() < 2) return std::nullopt;
  const int count = static_cast<int>(distinct.size());
  const EvenAxis axis{distinct.front(), (distinct.back() - distinct.front()) / (count - 1), count};
  for (int k = 0; k < count; ++k) {
    if (std::abs(distinct[k] - axis.first - k * axis.step) > 0.02 * axis.step) return std::nullopt;
  }
  return axis;
}

int nearest_node(const EvenAxis& axis, double at) {
  return static_cast<int>(std::lround((at - axis.first) / axis.step));
}

// Points in square bins of about two points each.
class Scatter {
 public:
  explicit Scatter(std::vector<SurveyPoint> points) : points_(std::move(points)) {
    low_ = {infinity, infinity};
    Point high{-infinity, -infinity};
    for (const SurveyPoint& p : points_) {
      low_ = {std::min(low_[0], p.x), std::min(low_[1], p.y)};
      high = {std::max(high[0], p.x), std::max(high[1], p.y)};
    }
    size_ = std::max(1.5 * mean_spacing(points_), 1e-9);
    nx_ = bins(high[0] - low_[0]);
    ny_ = bins(high[1] - low_[1]);
    bins_.resize(static_cast<std::size_t>(nx_) * ny_);
    for (std::size_t i = 0; i < points_.size(); ++i)
      bin(column(points_[i].x), row(points_[i].y)).push_back(i);
  }

  double level(double x, double y) {
    nearest_.clear();
    const int i = column(x), j = row(y);
    for (int ring = 0; ring < std::max(nx_, ny_) + 1; ++ring) {
      visit_ring(i, j, ring, x, y);
      // All nearer points lie within the rings visited so far.
      if (nearest_.size() >= neighbours && nearest_[neighbours - 1].distance2 <= reach2(ring, x, y)) break;
    }
    return weighted();
  }

 private:
  struct Neighbour {
    double distance2, z;
  };

  int bins(double length) const { return std::clamp(static_cast<int>(length / size_) + 1, 1, 20000); }
  int column(double x) const { return std::clamp(static_cast<int>((x - low_[0]) / size_), 0, nx_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - low_[1]) / size_), 0, ny_ - 1); }
  std::vector<std::size_t>& bin(int i, int j) { return bins_[static_cast<std::size_t>(j) * nx_ + i]; }

  // A query outside the box sits in an edge bin though it is farther away: its own distance to the bin comes
  // on top.
  double reach2(int ring, double x, double y) const {
    const double ux = x - low_[0] - column(x) * size_, uy = y - low_[1] - row(y) * size_;
    const double inside = std::min(std::min(ux, size_ - ux), std::min(uy, size_ - uy));
    const double reach = std::max(0.0, ring * size_ + std::min(inside, 0.0));
    return reach * reach;
  }

  void visit_ring(int i, int j, int ring, double x, double y) {
    for (int jj = std::max(j - ring, 0); jj <= std::min(j + ring, ny_ - 1); ++jj) {
      for (int ii = std::max(i - ring, 0); ii <= std::min(i + ring, nx_ - 1); ++ii) {
        if (std::max(std::abs(ii - i), std::abs(jj - j)) == ring) visit_bin(ii, jj, x, y);
      }
    }
  }

  void visit_bin(int i, int j, double x, double y) {
    for (const std::size_t k : bin(i, j)) {
      const double dx = points_[k].x - x, dy = points_[k].y - y;
      const Neighbour near{dx * dx + dy * dy, points_[k].z};
      const auto farther = [](const Neighbour& a, const Neighbour& b) { return a.distance2 < b.distance2; };
      nearest_.insert(std::upper_bound(nearest_.begin(), nearest_.end(), near, farther), near);
      if (nearest_.size() > neighbours) nearest_.pop_back();
    }
  }

  double weighted() const {
    if (nearest_.front().distance2 <= 1e-12 * size_ * size_) return nearest_.front().z;
    double sum = 0, weights = 0;
    for (const Neighbour& near : nearest_) {
      sum += near.z / near.distance2;
      weights += 1 / near.distance2;
    }
    return sum / weights;
  }

  std::vector<SurveyPoint> points_;
  Point low_{};
  double size_ = 1;
  int nx_ = 1, ny_ = 1;
  std::vector<std::vector<std::size_t>> bins_;
  std::vector<Neighbour> nearest_;
};

}  // namespace

std::vector<SurveyPoint> read_points(const std::string& path, const std::string& text) {
  std::vector<SurveyPoint> points;
  bool header = false;
  for_each_line(text, [&](int number, const std::string& line) {
    if (is_comment_or_empty(line)) return;
    const std::vector<std::string> cells = split_cells(line);
    SurveyPoint p{};
    const bool place = cells.size() >= 2 && parse_number(cells[0], p.x) && parse_number(cells[1], p.y);
    const bool level = cells.size() >= 3 && parse_number(cells[2], p.z);
    if (place && cells.size() >= 3 && !level && (cells[2] == "nan" || cells[2] == "NaN")) {
      p.z = std::numeric_limits<double>::quiet_NaN();
    } else if (!place || !level) {
      if (points.empty() && !header) {
        header = true;
        return;
      }
      throw BadData(at_line(path, number) + ": three numbers are wanted, x y z",
                    "the file is read as x-y-z points; an ESRI ASCII grid begins with 'ncols'");
    }
    points.push_back(p);
  });
  if (points.size() < 4) throw BadData("'" + file_name(path) + "' holds fewer than four x-y-z points");
  return points;
}

std::optional<Raster> as_lattice(const std::vector<SurveyPoint>& points) {
  std::vector<double> x, y;
  for (const SurveyPoint& p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  const auto columns = find_axis(std::move(x)), rows = find_axis(std::move(y));
  if (!columns || !rows) return std::nullopt;
  const std::size_t nodes = static_cast<std::size_t>(columns->count) * rows->count;
  if (points.size() > nodes || 2 * points.size() < nodes) return std::nullopt;
  Raster raster;
  raster.x0 = columns->first;
  raster.y0 = rows->first;
  raster.dx = columns->step;
  raster.dy = rows->step;
  raster.nx = columns->count;
  raster.ny = rows->count;
  raster.z.assign(nodes, std::numeric_limits<double>::quiet_NaN());
  for (const SurveyPoint& p : points) raster.at(nearest_node(*columns, p.x), nearest_node(*rows, p.y)) = p.z;
  return raster;
}

Function nearest_points(std::vector<SurveyPoint> points) {
  const auto scatter = std::make_shared<Scatter>(std::move(points));
  return [scatter](double x, double y) { return scatter->level(x, y); };
}

double mean_spacing(const std::vector<SurveyPoint>& points) {
  Point low{infinity, infinity}, high{-infinity, -infinity};
  for (const SurveyPoint& p : points) {
    low = {std::min(low[0], p.x), std::min(low[1], p.y)};
    high = {std::max(high[0], p.x), std::max(high[1], p.y)};
  }
  const double width = high[0] - low[0], height = high[1] - low[1];
  const double count = static_cast<double>(points.size());
  return std::max(std::sqrt(width * height / count), std::max(width, height) / count);
}

}  // namespace freshet::input
