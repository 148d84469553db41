#include "kernels/linear/mesh/point_mesh.hpp"

#include "kernels/linear/mesh/mesh_passes.hpp"

namespace freshet::linear {
namespace {

// w (value - mean)
struct Weighted {
  Field<double> weight, value;
  double mean;
  KOKKOS_FORCEINLINE_FUNCTION double operator()(int i) const { return weight(i) * (value(i) - mean); }
};

}  // namespace

void PointMesh::build(const Rows& rows, const VecField<double, 2>& x, int points, const Period& period,
                      const MeshWeights& weights) {
  const TimedRegion region("point_mesh::build");
  points_ = points;
  weight_ = weights.weight;
  mesh_.lay(rows, x, points, period);
  mesh_.set(Weighted{weight_, weights.held, 0.0}, weights.area);
  total_weight_ = weights.singular ? sum_of_values("point_mesh::weight", points, weight_) : 0;
}

double PointMesh::mean(const Vector& r) { return dot(points_, weight_, r) / total_weight_; }

void PointMesh::operator()(const Vector& r, const Vector& z) {
  const TimedRegion region("point_mesh::cycle");
  mesh_.solve(Weighted{weight_, r, total_weight_ > 0 ? mean(r) : 0.0});
  mesh_.add(r, weight_, z);
}

}  // namespace freshet::linear
