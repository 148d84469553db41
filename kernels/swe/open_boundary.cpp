#include "kernels/swe/open_boundary.hpp"

#include <algorithm>
#include <cmath>

namespace freshet::swe {
namespace {

// All rows of a boundary, piece after piece.
struct Section {
  std::vector<OpenRow> rows;
  std::vector<double> width;
};

// Rows that no fluid reaches take the state of the nearest row of the boundary that has one; without any they are dry.
void fill_gaps(std::vector<OpenRow>& rows) {
  const int n = static_cast<int>(rows.size());
  for (int r = 0; r < n; ++r) {
    if (rows[r].wet) continue;
    const OpenRow* source = nullptr;
    for (int away = 1; away < n && !source; ++away)
      for (const int other : {r - away, r + away})
        if (other >= 0 && other < n && rows[other].wet == 1) source = &rows[other];
    rows[r].level = source ? source->level : rows[r].bed;
    rows[r].speed = source ? source->speed : 0;
    rows[r].slip = source ? source->slip : 0;
  }
}

// The inner state of a row, and its slow means taken on by dt: over the time that a wave takes to cross `memory`; anew with
// dt = 0 and on the first water. What arrives meets a mean inflow so that it ends: u = 0 on the line. Uniform
// flow inwards would go on by itself, and grow.
InnerState inner_state(OpenRow& row, double gravity, double least, double memory, double dt) {
  const double depth = row.level - row.bed;
  if (depth <= least) {
    row.mean_speed = row.mean_celerity = 0;
    return {};
  }
  const double c = std::sqrt(gravity * depth);
  const double part = dt == 0 || row.mean_celerity == 0 ? 1 : 1 - std::exp(-c * dt / memory);
  row.mean_speed += part * (row.speed - row.mean_speed);
  row.mean_celerity += part * (c - row.mean_celerity);
  return {depth, row.speed, 2 * row.mean_celerity - std::abs(row.mean_speed)};
}

// Share of the discharge of each row; empty where nothing is to be shared.
std::vector<double> shares(const OpenLaw& law, const Section& section, double least) {
  const auto* discharge = std::get_if<ImposedDischarge>(&law);
  if (!discharge) return {};
  std::vector<Portion> portions;
  for (size_t r = 0; r < section.rows.size(); ++r) {
    const OpenRow& row = section.rows[r];
    portions.push_back({row.level, row.bed, section.width[r], row.level - row.bed > least});
  }
  return discharge_shares(portions, discharge->by_width);
}

void set_exterior(OpenRow& row, const InnerState& inner, const ExteriorState& exterior) {
  row.depth = exterior.depth;
  row.inward = exterior.inward;
  row.along = exterior.inward < 0 ? row.slip : 0.0;
  row.closed = exterior.closed;
  // Inwards move boundary particles. What leaves moves like the water before the line, then like the state behind it.
  const double outer = exterior.inward * exterior.depth;
  row.through = exterior.inward > 0 ? outer : exterior.closed ? 0.0 : 0.5 * (outer + inner.inward * inner.depth);
}

}  // namespace

template <int D>
OpenBoundary<D>::OpenBoundary(const std::vector<OpenLine<D>>& pieces, std::function<OpenLaw(double)> law,
                              const std::vector<double>& times, const OpenBufferOptions& options, double gravity, int first_owner)
    : law_(std::move(law)), times_(times), gravity_(gravity) {
  for (const OpenLine<D>& piece : pieces) buffers_.emplace_back(piece, options, first_owner++);
}

// Exterior states of all rows at time t; what passed since the last ones goes to the account.
template <int D>
void OpenBoundary<D>::impose(double t, double dt) {
  Section section;
  for (const auto& buffer : buffers_) {
    const std::vector<OpenRow> rows = buffer.rows();
    account(rows, buffer.width(), dt);
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
    section.width.resize(section.rows.size(), buffer.width());
  }
  fill_gaps(section.rows);
  const OpenLaw law = law_(t);
  const double least = buffers_.front().least_depth();
  const double memory = 10 * buffers_.front().smoothing();
  const std::vector<double> share = shares(law, section, least);
  for (size_t r = 0; r < section.rows.size(); ++r) {
    OpenRow& row = section.rows[r];
    const InnerState inner = inner_state(row, gravity_, least, memory, dt);
    set_exterior(row, inner,
                 exterior_state(law, inner, {gravity_, row.bed, row.still - row.bed, share.empty() ? 0.0 : share[r]}));
  }
  auto begin = section.rows.begin();
  for (auto& buffer : buffers_) {
    const auto end = begin + static_cast<std::ptrdiff_t>(buffer.rows().size());
    buffer.set({begin, end});
    begin = end;
  }
}

// The fastest that is imposed at any time, as it would enter dry land.
template <int D>
void OpenBoundary<D>::foresee() {
  double fastest = 1e-300, length = 0;
  for (const auto& buffer : buffers_) length += buffer.length();
  for (const double t : times_) {
    const OpenLaw law = law_(t);
    for (const auto& buffer : buffers_)
      for (const OpenRow& row : buffer.rows()) {
        const ExteriorState s = exterior_state(law, {}, {gravity_, row.bed, row.still - row.bed, 1 / length});
        fastest = std::max({fastest, s.inward, std::sqrt(gravity_ * s.depth)});
      }
  }
  crossing_time_ = buffers_.front().smoothing() / fastest;
}

template <int D>
void OpenBoundary<D>::account(const std::vector<OpenRow>& rows, double width, double dt) {
  for (const OpenRow& row : rows) {
    flow_.flux += row.through * width * dt;
    flow_.flux_gross += std::abs(row.through) * width * dt;
  }
}

// The level observed now is that of the water at rest.
template <int D>
void OpenBoundary<D>::take_still() {
  for (auto& buffer : buffers_) {
    std::vector<OpenRow> rows = buffer.rows();
    for (OpenRow& row : rows) row.still = row.wet ? row.level : row.bed;
    buffer.set(rows);
  }
}

template <int D>
void OpenBoundary<D>::fill(const Rows& rows, FieldSet& particles, const Bind<D>& bind, const Ground& bed, int& next_id) {
  for (auto& buffer : buffers_) buffer.survey(bed);
  observe(rows, bind(), particles.integer("kind"), bed);
  take_still();
  foresee();
  impose(0, 0);
  for (auto& buffer : buffers_) buffer.insert(particles, bind, bed, next_id);
}

template <int D>
void OpenBoundary<D>::start(const Particles<D>& p, const Field<int>& kind, int n) {
  take_still();
  flow_.straddle0 = straddling(p, kind, n);
}

template <int D>
void OpenBoundary<D>::observe(const Rows& rows, const Particles<D>& p, const Field<int>& kind, const Ground& bed) {
  for (auto& buffer : buffers_) buffer.observe(rows, p, kind, bed);
}

template <int D>
void OpenBoundary<D>::exchange(FieldSet& particles, const Bind<D>& bind, const Ground& bed, double t, double dt, int& next_id) {
  impose(t, dt);
  for (auto& buffer : buffers_) {
    const Crossed crossed = buffer.convert(particles, bind(), bed);
    flow_.inflow += crossed.in;
    flow_.outflow += crossed.out;
  }
  for (auto& buffer : buffers_) buffer.insert(particles, bind, bed, next_id);
}

template <int D>
double OpenBoundary<D>::straddling(const Particles<D>& p, const Field<int>& kind, int n) const {
  double volume = 0;
  for (const auto& buffer : buffers_) volume += buffer.straddling(p, kind, n);
  return volume;
}

namespace {

// The doubles of a row's state, in order; visit(double&) each.
template <class Row, class Visit>
void each_value(Row& row, const Visit& visit) {
  for (auto* value : {&row.bed, &row.level, &row.speed, &row.slip, &row.still, &row.depth, &row.inward, &row.along, &row.mean_speed,
                      &row.mean_celerity, &row.through})
    visit(*value);
}

}  // namespace

template <int D>
std::vector<double> OpenBoundary<D>::save() const {
  std::vector<double> state{flow_.inflow, flow_.outflow, flow_.flux, flow_.flux_gross, flow_.straddle0};
  for (const auto& buffer : buffers_)
    for (const OpenRow& row : buffer.rows()) {
      each_value(row, [&](const double& value) { state.push_back(value); });
      state.push_back(row.wet);
      state.push_back(row.closed);
    }
  return state;
}

template <int D>
void OpenBoundary<D>::restore(const std::vector<double>& state) {
  flow_ = {state.at(0), state.at(1), state.at(2), state.at(3), state.at(4)};
  size_t next = 5;
  for (auto& buffer : buffers_) {
    std::vector<OpenRow> rows = buffer.rows();
    for (OpenRow& row : rows) {
      each_value(row, [&](double& value) { value = state.at(next++); });
      row.wet = state.at(next++) != 0;
      row.closed = state.at(next++) != 0;
    }
    buffer.set(rows);
  }
}

template class OpenBoundary<1>;
template class OpenBoundary<2>;

}  // namespace freshet::swe
