// What methods for shallow water have in common: sorted particles with the fields of SortedWater over a bed,
// and what is looked up among them at fixed places.
#pragma once
#include <optional>

#include "kernels/ground/nearest_table.hpp"
#include "kernels/smoothing/smoothing.hpp"
#include "kernels/water/sampling.hpp"
#include "src/methods/method.hpp"
#include "src/scene/place/place.hpp"

namespace freshet {

// The scene's bed as particles feel it, filtered and tabulated over a region; absent where it is flat.
template <int D>
std::optional<BedSpline<D>> bed_spline(const Scene& scene, const Domain& over) {
  const Bed& bed = scene.bed;
  if (!bed.elevation) return {};
  const double spacing = bed.spacing > 0 ? bed.spacing : scene.water.spacing;
  return BedSpline<D>(bed.elevation, {over.low, over.high, spacing, bed.filter});
}

// m, at t = 0.
template <int D>
FRESHET_OUT_OF_LINE double initial_depth(const Scene& scene, const std::optional<BedSpline<D>>& bed,
                                         const Point& x) {
  if (!scene.water.surface) return scene.water.depth(x[0], x[1]);
  return scene.water.surface(x[0], x[1]) - (bed ? bed->at(to_vec<D>(x)).b : 0.0);
}

template <int D>
class ShallowWater : public Method {
 public:
  int dimension() const override { return D; }
  FieldSet& fields() override { return particles_; }
  const FieldSet& fields() const override { return particles_; }
  const Rows& rows() const override { return order_.rows(); }
  StepReport report() const override { return report_; }
  std::vector<PointState> sample(const std::vector<Point>& points) const override {
    std::vector<PointState> states;
    for (const SampledDepth& f : sampler_.sample(sorted_water<D>(rows(), particles_), bed(), points))
      states.push_back({f.bed, f.depth, f.reached != 0});
    return states;
  }
  void raise_wet_levels(const Shores& shores) const override {
    freshet::raise_wet_levels<D>(sorted_water<D>(rows(), particles_), bed(), scene_.water.spacing, shores);
  }

 protected:
  ShallowWater(const Scene& scene, const AnyKernel<D>& kernel)
      : scene_(scene), kernel_(kernel), support_(std::visit([](const auto& k) { return k.support; }, kernel)),
        order_(D, scene.water.spacing, sorted_box(scene)) {}

  const BedSpline<D>* bed() const { return bed_ ? &*bed_ : nullptr; }
  // factor n^2 where the scene has a map of n; else an empty table.
  NearestTable roughness(double factor) const {
    if (!scene_.manning || !scene_.manning->map) return {};
    const Manning& manning = *scene_.manning;
    const auto squared = [&](double x, double y) {
      const double n = manning.map(x, y);
      return factor * n * n;
    };
    return NearestTable(squared, {scene_.domain.low, scene_.domain.high, manning.node, manning.step});
  }

  Scene scene_;
  AnyKernel<D> kernel_;
  double support_;  // of the kernel, x smoothing length
  FieldSet particles_;
  RowOrder order_;
  std::optional<BedSpline<D>> bed_;
  StepReport report_;

 private:
  mutable Sampler<D> sampler_;
};

}  // namespace freshet
