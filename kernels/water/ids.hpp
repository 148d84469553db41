// Ids of new particles: each is given once in a run, and what is the same step of the same run gives the
// same.
#pragma once
#include <limits>
#include <stdexcept>
#include <string>

namespace freshet {

// A run has given all the ids that 32 bits hold.
struct OutOfIds : std::length_error {
  OutOfIds()
      : std::length_error("the run has let in or split " + std::to_string(std::numeric_limits<int>::max()) +
                          " particles, as many as there are numbers for\n  help: go on from its last output "
                          "as a new run, or "
                          "use a larger water.spacing") {}
};

// The first of `count` new ids, next_id .. next_id + count - 1. Throws OutOfIds.
inline int take_ids(int& next_id, int count) {
  const int first = next_id;
  if (count > std::numeric_limits<int>::max() - first) throw OutOfIds();
  next_id += count;
  return first;
}

}  // namespace freshet
