#include "kernels/swe/open/section.hpp"

#include <type_traits>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/on_device.hpp"

namespace freshet::swe {
namespace {

// The inner state of a row, and its slow means taken on by dt: over the time that a wave takes to cross
// `memory`; anew with dt = 0 and on the first water. What arrives meets a mean inflow so that it ends: u = 0
// on the line. Uniform flow inwards would go on by itself, and grow.
KOKKOS_INLINE_FUNCTION InnerState inner_state(OpenRow& row, const OpenSection::Scales& scales, double dt) {
  const double depth = row.level - row.bed;
  if (depth <= scales.least) {
    row.mean_speed = row.mean_celerity = 0;
    return {};
  }
  const double c = ::sqrt(scales.gravity * depth);
  const double part = dt == 0 || row.mean_celerity == 0 ? 1 : 1 - ::exp(-c * dt / scales.memory);
  row.mean_speed += part * (row.speed - row.mean_speed);
  row.mean_celerity += part * (c - row.mean_celerity);
  return {depth, row.speed, 2 * row.mean_celerity - ::fabs(row.mean_speed)};
}

KOKKOS_INLINE_FUNCTION
void set_exterior(OpenRow& row, const InnerState& inner, const ExteriorState& exterior) {
  row.depth = exterior.depth;
  row.inward = exterior.inward;
  row.along = exterior.inward < 0 ? row.slip : 0.0;
  row.closed = exterior.closed;
  // Inwards move boundary particles. What leaves moves like the water before the line, then like the state
  // behind it.
  const double outer = exterior.inward * exterior.depth;
  const double leaving = exterior.closed ? 0.0 : 0.5 * (outer + inner.inward * inner.depth);
  row.through = exterior.inward > 0 ? outer : leaving;
}

struct PortionOfRow {
  OpenRows rows;
  Field<double> width;
  double least;  // m

  KOKKOS_INLINE_FUNCTION Portion operator()(int r) const {
    const OpenRow& row = rows(r);
    return {row.level, row.bed, width(r), row.level - row.bed > least};
  }
};

template <class Law>
struct Impose {
  Law law;
  PortionOfRow portion;
  Kokkos::View<DischargeShares*, Memory> shares;
  OpenSection::Scales scales;
  double dt;

  KOKKOS_INLINE_FUNCTION void operator()(int r) const {
    OpenRow& row = portion.rows(r);
    double share = 0;
    if constexpr (std::is_same_v<Law, ImposedDischarge>) share = shares(0).of(portion(r));
    const InnerState inner = inner_state(row, scales, dt);
    set_exterior(row, inner, imposed(law, inner, {scales.gravity, row.bed, row.still - row.bed, share}));
  }
};

}  // namespace

OpenSection::OpenSection(const std::vector<double>& width, const Scales& scales)
    : scales_(scales), row_("open.rows", width.size()), width_(on_device("open.width", width)),
      flux_("open.flux", 1), shares_("open.shares", 1) {}

void OpenSection::take_still() const {
  const OpenRows rows = row_;
  launch(
      "open::take_still", Range(0, rows.extent_int(0)),
      KOKKOS_LAMBDA(int r) { rows(r).still = rows(r).wet ? rows(r).level : rows(r).bed; });
}

// Rows that no fluid reaches take the state of the nearest row of the boundary that has one; without any they
// are dry.
void OpenSection::fill_gaps() const {
  const OpenRows rows = row_;
  const int n = rows.extent_int(0);
  launch(
      "open::fill_gaps", Range(0, n), KOKKOS_LAMBDA(int r) {
        OpenRow& row = rows(r);
        if (row.wet) return;
        int source = -1;
        for (int away = 1; away < n && source < 0; ++away) {
          if (r - away >= 0 && rows(r - away).wet) source = r - away;
          if (r + away < n && rows(r + away).wet) source = r + away;
        }
        row.level = source < 0 ? row.bed : rows(source).level;
        row.speed = source < 0 ? 0.0 : rows(source).speed;
        row.slip = source < 0 ? 0.0 : rows(source).slip;
      });
}

// One after the other, as sums may not depend on the threads; a line has few rows.
void OpenSection::account(const OpenLaw& law, double dt) const {
  const PortionOfRow portion{row_, width_, scales_.least};
  const auto flux = flux_;
  const auto shares = shares_;
  const int n = row_.extent_int(0);
  const auto* discharge = std::get_if<ImposedDischarge>(&law);
  const bool shared = discharge != nullptr, by_width = shared && discharge->by_width;
  launch(
      "open::account", Range(0, 1), KOKKOS_LAMBDA(int) {
        for (int r = 0; r < n; ++r) {
          const double through = portion.rows(r).through, along = portion.width(r) * dt;
          flux(0).net += through * along;
          flux(0).gross += ::fabs(through) * along;
        }
        if (shared) shares(0) = DischargeShares(n, portion, by_width);
      });
}

void OpenSection::impose(const OpenLaw& law, double dt) const {
  fill_gaps();
  account(law, dt);
  const PortionOfRow portion{row_, width_, scales_.least};
  std::visit(
      [&](const auto& kind) {
        using Law = std::decay_t<decltype(kind)>;
        const Impose<Law> impose{kind, portion, shares_, scales_, dt};
        launch("open::impose", Range(0, row_.extent_int(0)), impose);
      },
      law);
}

std::vector<OpenRow> OpenSection::states() const {
  const auto host = on_host(row_);
  return {host.data(), host.data() + host.extent(0)};
}

OpenFlux OpenSection::flux() const { return on_host(flux_)(0); }

// In place: the pieces hold parts of the rows.
void OpenSection::restore(const std::vector<OpenRow>& rows, const OpenFlux& flux) {
  Kokkos::deep_copy(row_, on_device("open.rows", rows));
  Kokkos::deep_copy(flux_, on_device("open.flux", std::vector<OpenFlux>{flux}));
}

}  // namespace freshet::swe
