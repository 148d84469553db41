// Modelled work of a pass, for its rates against the machine's limits (`freshet profile`, perf/). The counts
// stand beside each kernel; perf/instructions compares them with the instructions that run. An operation is
// an addition, multiplication, minimum or maximum, a fused multiply-add two of them, an estimate of 1/sqrt
// one. Bytes: every field that a pass names is moved once.
#pragma once

namespace freshet {

struct Cost {
  double pair_flops = 0;  // per listed pair: a lane and a neighbour of its cluster, within the support or not
  double particle_flops = 0;
  double fields = 0;  // of 8 bytes, read or written, per particle
};

// Of one launch.
struct Work {
  double particles = 0;
  double pairs = 0;   // within the support; 0 where a pass walks no pairs
  double listed = 0;  // lanes x neighbours that are computed, pairs among them
  double flops = 0;
  double bytes = 0;
};

inline Work work_of(const Cost& cost, double particles) {
  return {particles, 0, 0, cost.particle_flops * particles, 8 * cost.fields * particles};
}

// width: lanes of a cluster, whose list of 4-byte indices is read once.
inline Work work_of(const Cost& cost, double particles, double pairs, double listed, int width) {
  return {particles, pairs, listed, cost.particle_flops * particles + cost.pair_flops * listed,
          8 * cost.fields * particles + 4 * listed / width};
}

}  // namespace freshet
