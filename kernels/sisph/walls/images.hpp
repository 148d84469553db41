// Mirror images behind walls. An image has the scalars of its source particle and its vectors reflected; they
// stand in slots behind the particles of every vector field that pairs read, refreshed by fill(). Nothing is
// launched where no wall is near.
#pragma once
#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet::sisph {

template <int D>
struct Images {
  int first = 0, count = 0;        // slots first ... first + count - 1
  Field<int> source;               // per image
  SymField<double, D> reflection;  // R = 1 - 2 m m^T, or -1 through a right-angled corner (1-D: always)

  int slots() const { return first + count; }

  KOKKOS_FORCEINLINE_FUNCTION static Sym<double, 1> of(const SymField<double, 1>& r, int k) {
    return {r.xx(k)};
  }
  KOKKOS_FORCEINLINE_FUNCTION static Sym<double, 2> of(const SymField<double, 2>& r, int k) {
    return {r.xx(k), r.xy(k), r.yy(k)};
  }

  void fill(const VecField<double, D>& v) const {
    if (count == 0) return;
    const Images images = *this;
    launch(
        "sisph::reflect", Range(0, count), KOKKOS_LAMBDA(int k) {
          put(v, images.first + k, of(images.reflection, k) * at(v, images.source(k)));
        });
  }

  // The velocity of an image behind a wall that holds the water: -v.
  void fill_opposed(const VecField<double, D>& v) const {
    if (count == 0) return;
    const Images images = *this;
    launch(
        "sisph::oppose", Range(0, count),
        KOKKOS_LAMBDA(int k) { put(v, images.first + k, -1.0 * at(v, images.source(k))); });
  }

  // The gradients of both components of a vector: R (grad v) R.
  void fill_gradient(const VecField<double, D>& of_u, const VecField<double, D>& of_v) const {
    if (count == 0) return;
    const Images images = *this;
    launch(
        "sisph::reflect_gradient", Range(0, count), KOKKOS_LAMBDA(int k) {
          reflect(of(images.reflection, k), of_u, of_v, {images.source(k), images.first + k});
        });
  }

  // Overloads: nvcc's lambdas capture nothing inside if constexpr.
  struct Slots {
    int from, to;
  };
  KOKKOS_FORCEINLINE_FUNCTION static void reflect(const Sym<double, 1>&, const VecField<double, 1>& of_u,
                                                  const VecField<double, 1>&, Slots s) {
    put(of_u, s.to, at(of_u, s.from));
  }
  KOKKOS_FORCEINLINE_FUNCTION static void reflect(const Sym<double, 2>& r, const VecField<double, 2>& of_u,
                                                  const VecField<double, 2>& of_v, Slots s) {
    const Vec<double, 2> u = r * at(of_u, s.from), v = r * at(of_v, s.from);
    put(of_u, s.to, r.xx * u + r.xy * v);
    put(of_v, s.to, r.xy * u + r.yy * v);
  }
};

}  // namespace freshet::sisph
