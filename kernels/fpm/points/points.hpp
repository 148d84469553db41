// Keeps the points of an incompressible flow well spread (docs/formulas/fpm.md (F27) to (F30)): holds them to
// their walls, merges what is too close, fills holes, edges and gaps, and gives new points their fields by
// MLS. Every decision is a function of positions, kinds and ids, taken by each point for itself: results do
// not depend on threads.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "cellgrid/particles/fields.hpp"
#include "kernels/fpm/cells/voronoi.hpp"
#include "kernels/fpm/points/transfer.hpp"

namespace freshet::fpm {

struct PointRule {
  double spacing;  // m, dx
  double support;  // m, h0: of the MLS that new points take their fields from; with the spacing where that
                   // varies
  double merge = 0.2;  // x support: pairs closer than this are merged
  double land = 0.25;  // x spacing: surface points closer than this to a wall point are taken away
  double apart = 0.8;  // x spacing: of two new points closer than this only one is inserted
  bool slip = true;    // false: walls hold the tangential velocity too
  VoronoiRule voronoi{};
};

// Which fields of the set new points need: all that a particle carries from step to step.
struct PointFields {
  std::vector<std::array<std::string, 2>> velocities;  // pairs of x and y components; walls hold them
  std::vector<std::string> scalars;
};

struct PointCount {
  long inserted = 0, merged = 0, removed = 0, landed = 0;
};

struct PointReport {
  int surface = 0;  // points on the free surface
  int failed = 0;   // cells that did not fit their buffers
  PointCount step;
};

// What is made here of each point.
struct PointMarks {
  Field<int> kind, side, surface;  // PointKind; of the tank, -1 in the fluid; 1 on the free surface
  VecField<double, 2> open;        // Cloud::open

  void declare(const FieldList& field) {
    field(kind, "kind", "1", Carry::state);
    field(side, "side", "1", Carry::state);
    field(surface, "surface", "1", Carry::state);
    field(open, "open_x", "open_y", "1", Carry::state);
  }
};

// Fields of the set: x, y [m], id, dx [m] where the spacing varies, and PointMarks.
class PointKeeper {
 public:
  PointKeeper(const PointRule& rule, const Tank& tank, const Period& period, PointFields carried);

  // After points moved: everything above. Sorts the points; new ones take the ids from next_id on.
  PointReport manage(FieldSet& points, RowOrder& order, int& next_id);

  // Only the surface flags, of points that are in order.
  PointReport flag(FieldSet& points, const RowOrder& order);

  Cloud cloud(const FieldSet& points, const RowOrder& order) const;
  const PointRule& rule() const { return rule_; }

 public:
  int hold_to_walls(FieldSet& points);
  void choose_partners(const Cloud& cloud, const Field<int>& surface, const Field<int>& side, int n);
  PointCount decide(const Cloud& cloud, const Field<int>& surface, const Field<int>& side, int n);
  int list_places(const Cloud& cloud, const Field<int>& side, int n, int merged);
  void fill_places(FieldSet& points, int merged, int count);
  void settle_places(FieldSet& points, int n, int merged, int& next_id);
  void hold_velocities(FieldSet& points);

 private:
  PointRule rule_;
  Tank tank_;
  Period period_;
  PointFields carried_;
  Voronoi voronoi_;
  Transfer transfer_;
  Field<int> partner_, fate_;  // of each point
  Field<int> owner_;           // the point that each place copies
  VecField<double, 2> where_;  // m, places: of merged pairs, then of new points
  Field<int> place_kind_, place_side_;
  Field<double> place_h_, place_slack_;  // m; of Transfer
  Field<double> value_;
};

}  // namespace freshet::fpm
