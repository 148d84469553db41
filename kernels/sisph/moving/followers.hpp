// Particles beside sides without walls, where particles move: each goes with the velocity of the particle of
// the water that was nearest to where it stood at t = 0, and keeps its depth. Water that the sides would not
// follow runs into them on one side and away on the other. Reads ids (0 ... particles - 1, in the order of
// places at t = 0), so that nothing of it is state. Nothing is launched where none follows.
#pragma once
#include "cellgrid/particles/order.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet::sisph {

template <int D>
class Followers {
 public:
  // Where particles stood at t = 0, in the order of rows.
  struct Origin {
    const Rows& rows;
    VecField<double, D> x;     // m
    Field<int> id, kind;       // kind > 0: beside the domain
    Vec<double, D> low, high;  // m, the domain
    double spacing;            // m
  };
  Followers() = default;
  explicit Followers(int particles, const Origin& start);

  // To be called when the order of particles changed.
  void locate(int particles, const Field<int>& id);
  // Each has what its leader has.
  void follow(const VecField<double, D>& v) const;

 public:
  Field<int> leaders(int particles,
                     const Origin& start) const;  // id of each particle's, by id; -1: it follows none
  void list(int particles, const Field<int>& leader);

 private:
  int count_ = 0;
  Field<int> follower_, leader_;  // ids
  Field<int> place_;              // by id
};

}  // namespace freshet::sisph
