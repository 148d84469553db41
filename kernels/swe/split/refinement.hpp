// Particles that cover too much area split, those that cover too little merge (Vacondio 2010, ch. 3,
// corrected: docs/formulas/swe.md (S46) to (S49)). A = m / rho (3.1) against a limit that may depend on the
// place. Mass, momentum and centre of mass are kept.
#pragma once
#include <functional>
#include <optional>

#include "kernels/boundaries/walls/walls.hpp"
#include "kernels/ground/regions.hpp"
#include "kernels/swe/particles.hpp"
#include "kernels/swe/split/pattern.hpp"

namespace freshet::swe {

struct SplitOptions {
  SplitPattern pattern;
  PlacedValue area;    // m^D: a particle that covers this or more is split
  double alpha;        // h of a daughter / h of its parent
  bool linear;         // daughters follow the symmetric part of grad v; else v_k = v_N
  double least_depth;  // m: thinner water is left alone
  int most_particles;  // a split that would make more of them does not take place
};

struct MergeOptions {
  PlacedValue area;        // m^D: particles that both cover less are merged
  PlacedValue split_area;  // m^D: what merges must not be split again
  double reach;            // of h: how far apart the two may be
};

// kh goes to eta^D m~, so h to eta (m~ / rho)^(1/D): d ln(kh / (eta^D m~)) / dt = - (c / (time h)) ln(kh /
// (eta^D m~)), where m~ is the particle's own mass or that of heavier ones within 2 h. With its own mass
// alone, a light particle among heavy ones sees a hole between them as shallow water and is drawn in: still
// water mixed by itself.
struct RelaxOptions {
  double eta, gravity;  // -, m/s2
  double time;          // in h / c; 0 = at once
  double longest;  // m: nothing here lets h0 grow beyond, so that the cap of h stays where it was for lone
                   // particles
};

// What happened since t = 0.
struct RefinementCount {
  long splits = 0, mergers = 0;
};

template <int D>
class Refinement {
 public:
  using Bind = std::function<Particles<D>()>;

  Refinement(std::optional<SplitOptions> split, std::optional<MergeOptions> merge, const RelaxOptions& relax)
      : split_(std::move(split)), merge_(std::move(merge)), relax_(relax) {
    if (split_) lay_pattern();
  }

  // After the drift, before the sort: splits and merges. clusters, near: those of the last list; particles
  // inserted since then do not merge. kind: nothing but fluid (0) is touched; empty: all is fluid. New
  // particles take the ids from next_id on.
  void adapt(FieldSet& particles, const Bind& bind, const Field<int>& kind, const ClusterSet& clusters,
             const NeighbourView& near, const WallView<D>& walls, int& next_id);

  // After the list, before the density: writes kh and h0. What h outgrows the list, the density pass reports.
  void relax(const ClusterSet& clusters, const NeighbourView& near, const Particles<D>& p,
             const Field<int>& kind, double dt) const;

  const RefinementCount& count() const { return count_; }
  std::vector<double> save() const {
    return {static_cast<double>(count_.splits), static_cast<double>(count_.mergers)};
  }
  void restore(const std::vector<double>& state) {
    count_ = {static_cast<long>(state[0]), static_cast<long>(state[1])};
  }

  // Splits what is too large; returns how many. Daughters that would stand behind a wall are mirrored back.
  int split(FieldSet& particles, const Bind& bind, const Field<int>& kind, const WallView<D>& walls,
            int& next_id);
  // Merges the pairs of which each is the other's nearest; returns how many. The second of a pair gets the id
  // -1.
  int merge(const Particles<D>& p, int n, const Field<int>& kind, const ClusterSet& clusters,
            const NeighbourView& near);

 public:
  void lay_pattern();
  void rank_parents(const Field<int>& id, int parents);
  void place_daughters(const Particles<D>& p, int parents, int first, int first_id,
                       const WallView<D>& walls) const;
  void choose_partners(const Particles<D>& p, int n, const Field<int>& kind, const ClusterSet& clusters,
                       const NeighbourView& near);

 private:
  std::optional<SplitOptions> split_;
  std::optional<MergeOptions> merge_;
  RelaxOptions relax_;
  RefinementCount count_;
  VecField<double, D> offset_;  // in h, daughters
  Field<double> share_;
  Field<int> parent_, copy_of_;  // of each split; of each new particle
  Field<int> parent_ids_;        // ascending
  Field<double> area_;           // m^D of particles that may merge, else huge
  Field<int> partner_;           // the particle that each would merge with, -1: none
};

}  // namespace freshet::swe
