// What water feels behind a wall (kernels/boundaries/walls/walls.hpp); to add a kind, write its row and name
// it in wall_kinds().
#pragma once
#include <vector>

namespace freshet {

// Where virtual particles lie on the way from i through a wall point, in units of their distance.
struct Stretch {
  int count = 0;
  double factor[2] = {1, 1};
};

// name, title: a scene's word for it, and what the program shows.
struct WallKind {
  const char *name, *title;
  bool felt = true;     // false: walls only throw back what crosses them
  bool mirror = false;  // images of the water itself; walls then slip
  bool rows = false;    // rows of points behind the wall, else points on its face, ...
  bool corners = true;  // ... two more of them in each corner
  Stretch stretch{1, {1, 1}};
  // images where every corner of the walls is a right one with the water inside, else rows
  bool by_corners = false;
  bool can_hold() const { return felt && !mirror; }  // the tangential velocity, too
  const WallKind& resolved(bool only_right_corners) const {
    return !by_corners ? *this : only_right_corners ? images : image_rows;
  }

  static const WallKind automatic, none, vbp, mvbp, image_rows, images;
};

inline constexpr WallKind WallKind::automatic{"automatic", "automatic", true,        false,
                                              false,       true,        {1, {1, 1}}, true};
inline constexpr WallKind WallKind::none{"none", "reflection only", false};
inline constexpr WallKind WallKind::vbp{"vbp", "VBP", true, false, false, false, {1, {2, 2}}};
inline constexpr WallKind WallKind::mvbp{"mvbp", "MVBP", true, false, false, true, {2, {2, 4}}};
inline constexpr WallKind WallKind::image_rows{"rows", "rows", true, false, true};
inline constexpr WallKind WallKind::images{"mirror", "mirror images", true, true};

inline std::vector<WallKind> wall_kinds() {
  return {WallKind::automatic, WallKind::none,       WallKind::vbp,
          WallKind::mvbp,      WallKind::image_rows, WallKind::images};
}

}  // namespace freshet
