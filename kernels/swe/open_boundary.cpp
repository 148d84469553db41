#include "kernels/swe/open_boundary.hpp"

#include <cmath>

#include "cellgrid/sums.hpp"
#include "kernels/swe/lattice.hpp"

namespace freshet::swe {
namespace {

// Position relative to the line: inwards [m], and the row along it.
struct Station {
  double inside;
  int row;
  bool beside;  // within the line's ends
};

template <int D>
struct Frame {
  OpenLine<D> line;
  double width;
  int rows;

  KOKKOS_INLINE_FUNCTION Station operator()(const Vec<double, D>& x) const {
    const Vec<double, D> from = x - line.origin;
    if constexpr (D == 1) return {dot(from, line.inward), 0, true};
    const double along = dot(from, line.tangent);
    const double strip = ::floor(along / width);
    const int row = strip > 0 ? (strip < rows - 1 ? static_cast<int>(strip) : rows - 1) : 0;
    return {dot(from, line.inward), row, along > -width && along < line.length + width};
  }
  KOKKOS_INLINE_FUNCTION Vec<double, D> point(int row, double inside) const {
    return line.origin + inside * line.inward + ((row + 0.5) * width) * line.tangent;
  }
};

template <int D>
KOKKOS_FORCEINLINE_FUNCTION double bed_at(const std::optional<Bed<D>>& bed, const Vec<double, D>& x) {
  return bed ? bed->spline.at(x).b : 0.0;
}

// Depth of a boundary particle: the row's level over the bed beyond the line, so that still water stays still there; never
// less than a fifth of the depth on the line.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION double outer_depth(const std::optional<Bed<D>>& bed, const Vec<double, D>& on_line,
                                               const Vec<double, D>& x, double depth) {
  return larger(depth + bed_at<D>(bed, on_line) - bed_at<D>(bed, x), 0.2 * depth);
}

constexpr int columns = 5;  // of boundary particles: at least 2h

}  // namespace

template <int D>
OpenBoundary<D>::OpenBoundary(const OpenLine<D>& line, OpenKind kind, std::function<double(double)> level, double spacing,
                              double eta, double gravity)
    : line_(line), kind_(kind), level_(std::move(level)), spacing_(spacing), eta_(eta), gravity_(gravity),
      buffer_(columns * spacing), summed_(lattice_sums<D>(eta).density) {
  rows_ = D == 1 ? 1 : std::max(1, static_cast<int>(std::lround(line.length / spacing)));
  width_ = D == 1 ? 1 : line.length / rows_;
  row_ = Kokkos::View<Row*, Memory>("open.rows", static_cast<size_t>(rows_));
  farthest_ = Field<double>("open.farthest", static_cast<size_t>(rows_));
  room_ = Field<int>("open.room", static_cast<size_t>(rows_ + 1));
}

template <int D>
void OpenBoundary<D>::observe(const Rows& rows, const Particles<D>& p, const Field<int>& kind, const std::optional<Bed<D>>& bed) {
  const Frame<D> frame{line_, width_, rows_};
  const auto row = row_;
  const std::optional<Bed<D>> ground = bed;
  const Particles<D> f = p;
  const double summed = summed_;
  Kokkos::parallel_for("open::observe", Range(0, rows_), KOKKOS_LAMBDA(int r) {
        const Vec<double, D> at_line = frame.point(r, 0);
        double y = 0;
        if constexpr (D == 2) y = at_line.y;
        const double far = Kernel<D>::support * rows.largest_h(at_line.x, at_line.x, y, y);
        double weight = 0, level = 0, speed = 0;
        rows.for_each_run(at_line.x, at_line.x, y, y, far, [&](int begin, int end) {
          for (int j = begin; j < end; ++j) {
            if (kind(j) != OpenBoundary::fluid) continue;
            const Vec<double, D> d = at(f.x, j) - at_line;
            const double w = f.m(j) / f.rho(j) * power<D>(f.inv_h(j)) * Kernel<D>::at(root(dot(d, d)) * f.inv_h(j)).w;
            weight += w;
            level += w * (f.rho(j) / summed + (ground ? ground->level(j) : 0.0));
            speed += w * dot(at(f.v, j), frame.line.inward);
          }
        });
        if (weight <= 0) return;
        row(r).level = level / weight;
        row(r).speed = speed / weight;
        if (!row(r).observed) row(r).still = row(r).level;
        row(r).observed = 1;
      });
}

template <int D>
void OpenBoundary<D>::set_exterior(double t, const std::optional<Bed<D>>& bed) {
  const Frame<D> frame{line_, width_, rows_};
  const auto row = row_;
  const std::optional<Bed<D>> ground = bed;
  const double level = level_(t), g = gravity_, least = 1e-6 * spacing_;
  const bool wave = kind_ == OpenKind::wave;
  Kokkos::parallel_for("open::exterior", Range(0, rows_), KOKKOS_LAMBDA(int r) {
        Row& s = row(r);
        const double b = bed_at<D>(ground, frame.point(r, 0));
        const double c_inner = root(g * larger(s.level - b, least)), c_level = root(g * larger(level - b, least));
        if (wave) {  // incoming invariant u + 2c of the wave alone, outgoing u - 2c of the inner state
          const double c_still = root(g * larger(s.still - b, least));
          const double incoming = 4 * c_level - 2 * c_still, outgoing = s.speed - 2 * c_inner;
          const double c = larger(0.25 * (incoming - outgoing), 0.0);
          s.inward = 0.5 * (incoming + outgoing);
          s.depth = larger(c * c / g, least);
        } else {  // (4.2): d imposed, u_b = u_i + 2 (c_b - c_i) with u inwards
          s.inward = s.speed + 2 * (c_level - c_inner);
          s.depth = c_level * c_level / g;
        }
        // Inwards move boundary particles. What leaves moves like the water before the line, then like the state behind it.
        const double outer = s.inward * s.depth, inner = s.speed * larger(s.level - b, least);
        s.through = s.inward > 0 ? outer : 0.5 * (outer + inner);
      });
}

template <int D>
void OpenBoundary<D>::convert(FieldSet& particles, const Particles<D>& p, const std::optional<Bed<D>>& bed) {
  const Frame<D> frame{line_, width_, rows_};
  const auto row = row_;
  const std::optional<Bed<D>> ground = bed;
  const Particles<D> f = p;
  const Field<int> kind = particles.integer("kind");
  const double trim = buffer_ + 0.75 * spacing_, summed = summed_;
  const auto crossed = sums_.template sum<2>("open::convert", particles.size(), KOKKOS_LAMBDA(int i) {
        Kokkos::Array<double, 2> in_out{};
        const Vec<double, D> x = at(f.x, i);
        if (kind(i) == OpenBoundary::fluid && dot(x - frame.line.origin, frame.line.inward) >= 0) return in_out;
        const Station s = frame(x);
        if (!s.beside || s.inside < -2 * trim) return in_out;
        if (kind(i) == OpenBoundary::boundary && s.inside >= 0) {
          kind(i) = OpenBoundary::fluid;
          in_out[0] = f.m(i);
        } else if (kind(i) == OpenBoundary::fluid && s.inside < 0) {
          kind(i) = OpenBoundary::boundary;
          in_out[1] = f.m(i);
        }
        if (kind(i) != OpenBoundary::boundary) return in_out;
        const Row state = row(s.row);
        const double rho = summed * outer_depth<D>(ground, frame.point(s.row, 0), x, state.depth);
        f.m(i) *= rho / f.rho(i);  // the particle keeps its area, and with it h
        f.kh(i) *= rho / f.rho(i);
        f.rho(i) = rho;
        f.rate(i) = 0;
        f.h(i) = smoothing_length<D>(f.kh(i), rho);
        put(f.v, i, state.inward * frame.line.inward);
        put(f.v_pred, i, state.inward * frame.line.inward);
        if (s.inside < -trim) f.id(i) = -1;
        return in_out;
      });
  flow_.inflow += crossed[0];
  flow_.outflow += crossed[1];
}

template <int D>
void OpenBoundary<D>::insert(FieldSet& particles, const std::function<Particles<D>()>& bind, const std::optional<Bed<D>>& bed,
                             int& next_id) {
  const Frame<D> frame{line_, width_, rows_};
  const auto row = row_;
  const int n = particles.size(), rows = rows_;
  const Field<int> id = particles.integer("id"), kind = particles.integer("kind");
  const VecField<double, D> x = bind().x;
  const Field<double> farthest = farthest_;
  const double dx = spacing_, limit = buffer_ + 0.25 * spacing_;
  Kokkos::parallel_for("open::start_rows", Range(0, rows), KOKKOS_LAMBDA(int r) { farthest(r) = -0.5 * dx; });
  Kokkos::parallel_for("open::outermost", Range(0, n), KOKKOS_LAMBDA(int i) {
        if (id(i) < 0 || kind(i) != OpenBoundary::boundary) return;
        const Station s = frame(at(x, i));
        if (s.beside) Kokkos::atomic_fetch_max(&farthest(s.row), -s.inside);
      });
  const Field<int> room = room_;
  int added = 0;
  Kokkos::parallel_scan("open::room", Range(0, rows + 1), KOKKOS_LAMBDA(int r, int& sum, bool last) {
        if (last) room(r) = sum;
        if (r < rows) sum += static_cast<int>(larger(0.0, ::floor((limit - farthest(r)) / dx)));
      });
  Kokkos::deep_copy(added, Kokkos::subview(room, rows));
  if (added == 0) return;
  particles.resize(n + added);
  const Particles<D> f = bind();
  const Field<int> new_id = particles.integer("id"), new_kind = particles.integer("kind");
  const std::optional<Bed<D>> ground = bed;
  const double area = D == 1 ? dx : dx * width_, h = eta_ * (D == 1 ? area : root(area));
  const int first_id = next_id;
  const double summed = summed_;
  Kokkos::parallel_for("open::insert", Range(0, rows), KOKKOS_LAMBDA(int r) {
        for (int k = room(r); k < room(r + 1); ++k) {
          const int i = n + k;
          const Vec<double, D> here = frame.point(r, -(farthest(r) + (k - room(r) + 1) * dx));
          const double depth = outer_depth<D>(ground, frame.point(r, 0), here, row(r).depth);
          put(f.x, i, here);
          put(f.v, i, row(r).inward * frame.line.inward);
          put(f.v_pred, i, row(r).inward * frame.line.inward);
          f.m(i) = depth * area;
          f.rho(i) = summed * depth;
          f.rate(i) = 0;
          f.h0(i) = h;
          f.kh(i) = depth * power<D>(h);
          f.h(i) = smoothing_length<D>(f.kh(i), f.rho(i));
          new_id(i) = first_id + k;
          new_kind(i) = OpenBoundary::boundary;
        }
      });
  next_id += added;
}

template <int D>
void OpenBoundary<D>::fill(FieldSet& particles, const std::function<Particles<D>()>& bind, const std::optional<Bed<D>>& bed,
                           int& next_id) {
  const auto row = row_;
  const Frame<D> frame{line_, width_, rows_};
  const std::optional<Bed<D>> ground = bed;
  const double level = level_(0.0), least = 1e-6 * spacing_;
  Kokkos::parallel_for("open::still", Range(0, rows_), KOKKOS_LAMBDA(int r) {
        row(r).level = row(r).still = level;
        row(r).depth = larger(level - bed_at<D>(ground, frame.point(r, 0)), least);
      });
  insert(particles, bind, bed, next_id);
}

template <int D>
void OpenBoundary<D>::exchange(FieldSet& particles, const std::function<Particles<D>()>& bind, const std::optional<Bed<D>>& bed,
                               double t, double dt, int& next_id) {
  const auto host = on_host(row_);  // the states that the boundary particles just moved with
  for (int r = 0; r < rows_; ++r) {
    flow_.flux += host(r).through * width_ * dt;
    flow_.flux_gross += std::abs(host(r).through) * width_ * dt;
  }
  set_exterior(t, bed);
  convert(particles, bind(), bed);
  insert(particles, bind, bed, next_id);
}

template <int D>
double OpenBoundary<D>::straddling(const Particles<D>& p, const Field<int>& kind, int n) const {
  const Frame<D> frame{line_, width_, rows_};
  const Particles<D> f = p;
  return sums_.template sum<1>("open::straddling", n, KOKKOS_LAMBDA(int i) {
    const Station s = frame(at(f.x, i));
    const double area = f.m(i) / f.rho(i), width = D == 1 ? area : root(area);
    const double across = larger(0.0, 0.5 - (s.inside < 0 ? -s.inside : s.inside) / width);
    const double sign = kind(i) == OpenBoundary::boundary ? 1.0 : -1.0;
    return Kokkos::Array<double, 1>{s.beside ? sign * across * f.m(i) : 0.0};
  })[0];
}

template <int D>
std::vector<double> OpenBoundary<D>::save() const {
  std::vector<double> state{flow_.inflow, flow_.outflow, flow_.flux, flow_.flux_gross, flow_.straddle0};
  const auto host = on_host(row_);
  for (int r = 0; r < rows_; ++r)
    for (const double value : {host(r).level, host(r).speed, host(r).still, host(r).depth, host(r).inward, host(r).through,
                               static_cast<double>(host(r).observed)})
      state.push_back(value);
  return state;
}

template <int D>
void OpenBoundary<D>::restore(const std::vector<double>& s) {
  flow_ = {s[0], s[1], s[2], s[3], s[4]};
  auto host = Kokkos::create_mirror_view(row_);
  for (size_t r = 0, k = 5; k + 6 < s.size(); ++r, k += 7)
    host(r) = {s[k], s[k + 1], s[k + 2], s[k + 3], s[k + 4], s[k + 5], static_cast<int>(s[k + 6])};
  Kokkos::deep_copy(row_, host);
}

template class OpenBoundary<1>;
template class OpenBoundary<2>;

}  // namespace freshet::swe
