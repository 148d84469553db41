#include "kernels/sisph/velocity/semi_lagrangian.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {
namespace {

template <int D>
constexpr int terms_of = SemiLagrangian<D>::terms;

// The monomials of an offset in units of the spacing.
template <class V>
KOKKOS_FORCEINLINE_FUNCTION void monomials(const Vec<V, 1>& a, V* term) {
  term[0] = a.x, term[1] = a.x * a.x;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION void monomials(const Vec<V, 2>& a, V* term) {
  term[0] = a.x, term[1] = a.y, term[2] = a.x * a.x, term[3] = a.x * a.y, term[4] = a.y * a.y;
}

// Wendland C2 over the support.
KOKKOS_FORCEINLINE_FUNCTION Lane fit_weight(Lane r) {
  const Lane p = larger(1.0 - r, Lane(0.0)), p2 = p * p;
  return p2 * p2 * (1.0 + 4.0 * r);
}

KOKKOS_FORCEINLINE_FUNCTION constexpr int packed(int a, int b) {
  return a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b;
}

// The inverse of a symmetric positive matrix by Gauss and Jordan; directions without information stay zero.
template <int N>
KOKKOS_INLINE_FUNCTION void invert(double (&m)[N][N]) {
  double largest_pivot = 0;
  for (int a = 0; a < N; ++a) largest_pivot = larger(largest_pivot, m[a][a]);
  for (int p = 0; p < N; ++p) {
    const double pivot = m[p][p], per = pivot > 1e-10 * largest_pivot ? 1.0 / pivot : 0.0;
    m[p][p] = 1;
    for (int b = 0; b < N; ++b) m[p][b] *= per;
    for (int a = 0; a < N; ++a) {
      if (a == p) continue;
      const double factor = m[a][p];
      m[a][p] = 0;
      for (int b = 0; b < N; ++b) m[a][b] -= factor * m[p][b];
    }
  }
}

// Per particle: the inverse of sum_j w phi phi^T, the means of phi (times the share of the lift), and a
// quarter of the squared distance to the nearest neighbour.
template <int D>
struct FitMoments {
  Geometry<D> g;
  double per_spacing, per_support;
  int stride;
  Field<double> inverse, mean, own2;

  KOKKOS_FUNCTION void operator()(int k) const {
    constexpr int n = terms_of<D>;
    constexpr double lift_per_aside = 20;
    const int s = g.slices(k);
    const Lanes me = g.pairs(s);
    Lane sum[n * (n + 1) / 2], first[n], weights(0.0), nearest(1e300);
    for (Lane& m : sum) m = Lane(0.0);
    for (Lane& m : first) m = Lane(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex) {
      const Lane d = PairView::load(g.distance, e),
                 here = select(Lane(0.0) < PairView::load(g.weight, e), Lane(1.0), Lane(0.0));
      const Lane w = here * fit_weight(per_support * d);
      Lane term[n];
      monomials((per_spacing * d) * PairView::load(g.n, e), term);
      for (int a = 0; a < n; ++a) {
        first[a] += w * term[a];
        for (int b = 0; b <= a; ++b) sum[packed(a, b)] += w * term[a] * term[b];
      }
      weights += w;
      nearest = smaller(nearest, select(Lane(0.0) < here, d * d, Lane(1e300)));
    });
    for (int l = 0; l < me.count; ++l) {
      double m[n][n];
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) m[a][b] = lane_of(sum[packed(a, b)], l);
      invert(m);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b <= a; ++b)
          inverse(static_cast<size_t>(packed(a, b)) * stride + me.particle(l)) = m[a][b];
      const double per = 1 / (lane_of(weights, l) + 1e-300);
      double aside2 = 0;  // of the neighbours' middle, in spacings
      for (int a = 0; a < D; ++a) aside2 += per * per * lane_of(first[a], l) * lane_of(first[a], l);
      const double lift = per * smaller(lift_per_aside * root(aside2), 1.0);
      for (int a = 0; a < n; ++a)
        mean(static_cast<size_t>(a) * stride + me.particle(l)) = lift * lane_of(first[a], l);
      mean(static_cast<size_t>(n) * stride + me.particle(l)) = lift;
    }
    me.store(own2, 0.25 * nearest);
  }
};

KOKKOS_FORCEINLINE_FUNCTION void components(const Vec<Lane, 1>& v, const Vec<Lane, 1>& u, Lane (&all)[2]) {
  all[0] = v.x, all[1] = u.x;
}
KOKKOS_FORCEINLINE_FUNCTION void components(const Vec<Lane, 2>& v, const Vec<Lane, 2>& u, Lane (&all)[4]) {
  all[0] = v.x, all[1] = v.y, all[2] = u.x, all[3] = u.y;
}

template <int D>
struct Fit {
  Geometry<D> g;
  double per_spacing, per_support;
  int stride;
  Field<double> inverse, mean;
  VecField<double, D> v, u;
  Field<double> fitted;

  KOKKOS_FUNCTION void operator()(int k) const {
    constexpr int n = terms_of<D>, fields = 2 * D;
    const int s = g.slices(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(v), ui = me.load(u);
    Lane sum[fields][n], height[fields];
    for (auto& row : sum)
      for (Lane& value : row) value = Lane(0.0);
    for (Lane& value : height) value = Lane(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane d = PairView::load(g.distance, e);
      // Padding lies at its own particle: every difference is zero.
      Lane term[n], difference[fields];
      monomials((per_spacing * d) * PairView::load(g.n, e), term);
      components(gather(v, j) - vi, gather(u, j) - ui, difference);
      const Lane w = fit_weight(per_support * d);
      for (int a = 0; a < n; ++a) {
        const Lane weighted = w * term[a];
        for (int f = 0; f < fields; ++f) sum[f][a] += weighted * difference[f];
      }
      for (int f = 0; f < fields; ++f) height[f] += w * difference[f];
    });
    const Lane free = free_lanes(g, me), per = load_at(mean, n, me);
    for (Lane& value : height) value = per * value;
    for (int a = 0; a < n; ++a) {
      Lane row[n];
      for (int b = 0; b < n; ++b) row[b] = free * load_at(inverse, packed(a, b), me);
      for (int f = 0; f < fields; ++f) {
        Lane value(0.0);
        for (int b = 0; b < n; ++b) value += row[b] * sum[f][b];
        store_at(fitted, f * (n + 1) + a, me, value);
        height[f] -= value * load_at(mean, a, me);
      }
    }
    for (int f = 0; f < fields; ++f) store_at(fitted, f * (n + 1) + n, me, free * height[f]);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION Lane load_at(const Field<double>& f, int row, const Lanes& me) const {
    return lanes_of<Lane>([&](int lane) {
      return lane < me.count ? f(static_cast<size_t>(row) * stride + me.particle(lane)) : 0.0;
    });
  }
  KOKKOS_FORCEINLINE_FUNCTION void store_at(const Field<double>& f, int row, const Lanes& me,
                                            Lane value) const {
    for_each_lane(value, [&](int lane, double one) {
      if (lane < me.count) f(static_cast<size_t>(row) * stride + me.particle(lane)) = one;
    });
  }
};

template <int D>
struct Trace {
  Geometry<D> g;
  Rows rows;
  double spacing, dt;
  int stride;
  Field<double> own2, fitted;
  VecField<double, D> v, u, last, carried;

  // The particle nearest to a place, starting from one nearby.
  KOKKOS_FUNCTION int nearest(const Vec<double, D>& place, int start) const {
    const auto square = [&](int j) {
      const Vec<double, D> d = place - at(g.x, j);
      return dot(d, d);
    };
    int best = start;
    double least = square(start);
    if (least < own2(start)) return start;
    for (double far = 1.1 * spacing; far < 20 * spacing;
         far *= 2) {  // no place among the particles is further from one
      rows.for_each_run(place.x, place.x, y_of(place), y_of(place), far, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
          if (square(j) < least) best = j, least = square(j);
      });
      if (least < far * far) break;
    }
    return best;
  }

  // The polynomial of the particle, lifted by a part of its neighbours' height over it: first = 0 for v, D
  // for u.
  KOKKOS_FUNCTION Vec<double, D> value(const VecField<double, D>& f, int first, int j,
                                       const Vec<double, D>& place, double lifted) const {
    constexpr int n = terms_of<D>;
    double term[n + 1];
    monomials((1.0 / spacing) * (place - at(g.x, j)), term);
    term[n] = lifted;
    Vec<double, D> sum = at(f, j);
    for (int a = 0; a <= n; ++a) {
      sum.x += fitted(static_cast<size_t>(first * (n + 1) + a) * stride + j) * term[a];
      if constexpr (D == 2)
        sum.y += fitted(static_cast<size_t>((first + 1) * (n + 1) + a) * stride + j) * term[a];
    }
    return sum;
  }

  KOKKOS_FUNCTION void operator()(int k) const {
    const Lanes me = g.pairs(g.slices(k));
    for (int l = 0; l < me.count; ++l) {
      const int i = me.particle(l);
      if (g.free(i) < 0.5) {
        put(carried, i, at(u, i));
        continue;
      }
      const Vec<double, D> xi = at(g.x, i), guess = xi - dt * at(v, i);
      const int before = nearest(guess, i);
      const Vec<double, D> foot = xi - (0.5 * dt) * (at(last, i) + value(v, 0, before, guess, 0));
      const Vec<double, D> way = foot - xi;
      put(carried, i, value(u, D, nearest(foot, before), foot, smaller(root(dot(way, way)) / spacing, 1.0)));
    }
  }
};

}  // namespace

template <int D>
SemiLagrangian<D>::SemiLagrangian(const Geometry<D>& g, const Rows& rows, double spacing, double support)
    : g_(g), rows_(rows), spacing_(spacing), support_(support), stride_(g.pairs.particles + lanes),
      inverse_("sisph.fit_inverse",
               static_cast<size_t>(terms * (terms + 1) / 2) * static_cast<size_t>(stride_)),
      mean_("sisph.fit_mean", static_cast<size_t>(terms + 1) * static_cast<size_t>(stride_)),
      own2_("sisph.own2", static_cast<size_t>(stride_)),
      fitted_("sisph.fitted", static_cast<size_t>(2 * D * (terms + 1)) * static_cast<size_t>(stride_)) {
  launch("sisph::fit_moments", Range(0, g.slices.count),
         FitMoments<D>{g, 1 / spacing, 1 / support, stride_, inverse_, mean_, own2_});
}

template <int D>
void SemiLagrangian<D>::fit(const VecField<double, D>& v, const VecField<double, D>& u, bool slip) {
  for (const VecField<double, D>& field : {v, u}) {
    if (slip) g_.images.fill(field);
    else g_.images.fill_opposed(field);
  }
  launch("sisph::fit", Range(0, g_.slices.count),
         Fit<D>{g_, 1 / spacing_, 1 / support_, stride_, inverse_, mean_, v, u, fitted_});
}

template <int D>
void SemiLagrangian<D>::trace(const VecField<double, D>& v, const VecField<double, D>& u,
                              const VecField<double, D>& last, double dt,
                              const VecField<double, D>& carried) const {
  launch("sisph::trace", Range(0, g_.slices.count),
         Trace<D>{g_, rows_, spacing_, dt, stride_, own2_, fitted_, v, u, last, carried});
}

template class SemiLagrangian<1>;
template class SemiLagrangian<2>;

}  // namespace freshet::sisph
