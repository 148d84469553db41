#include "kernels/swe/open/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace freshet::swe {
namespace {

template <int D>
std::vector<OpenBuffer<D>> lay_out(const std::vector<OpenLine<D>>& pieces, const OpenBufferOptions& options,
                                   int first_owner) {
  std::vector<OpenBuffer<D>> buffers;
  for (const OpenLine<D>& piece : pieces) buffers.emplace_back(piece, options, first_owner++);
  return buffers;
}

template <int D>
std::vector<double> widths(const std::vector<OpenBuffer<D>>& buffers) {
  std::vector<double> all;
  for (const auto& buffer : buffers)
    all.insert(all.end(), static_cast<std::size_t>(buffer.rows()), buffer.width());
  return all;
}

}  // namespace

template <int D>
BufferedLine<D>::BufferedLine(const std::vector<OpenLine<D>>& pieces, std::function<OpenLaw(double)> law,
                              const std::vector<double>& times, const OpenBufferOptions& options,
                              double gravity, int first_owner)
    : law_(std::move(law)), times_(times), gravity_(gravity), buffers_(lay_out(pieces, options, first_owner)),
      section_(widths(buffers_),
               {gravity, buffers_.front().least_depth(), 10 * buffers_.front().smoothing()}) {
  int begin = 0;
  for (auto& buffer : buffers_) {
    buffer.take_rows(Kokkos::subview(section_.rows(), std::make_pair(begin, begin + buffer.rows())));
    begin += buffer.rows();
  }
}

// The fastest that is imposed at any time, as it would enter dry land.
template <int D>
void BufferedLine<D>::foresee() {
  double fastest = 1e-300, length = 0;
  for (const auto& buffer : buffers_) length += buffer.length();
  const std::vector<OpenRow> rows = section_.states();
  for (const double t : times_) {
    const OpenLaw law = law_(t);
    for (const OpenRow& row : rows) {
      const ExteriorState s = exterior_state(law, {}, {gravity_, row.bed, row.still - row.bed, 1 / length});
      fastest = std::max({fastest, s.inward, std::sqrt(gravity_ * s.depth)});
    }
  }
  crossing_time_ = buffers_.front().smoothing() / fastest;
}

template <int D>
void BufferedLine<D>::fill(const Rows& rows, FieldSet& particles, const Bind<D>& bind, const Ground& bed,
                           int& next_id) {
  for (auto& buffer : buffers_) buffer.survey(bed);
  observe(rows, bind(), particles.integer("kind"), bed);
  section_.take_still();
  foresee();
  section_.impose(law_(0), 0);
  for (auto& buffer : buffers_) buffer.insert(particles, bind, bed, next_id);
}

template <int D>
void BufferedLine<D>::start(const Particles<D>& p, const Field<int>& kind, int n) {
  section_.take_still();
  flow_.straddle0 = straddling(p, kind, n);
}

template <int D>
void BufferedLine<D>::observe(const Rows& rows, const Particles<D>& p, const Field<int>& kind,
                              const Ground& bed) {
  for (auto& buffer : buffers_) buffer.observe(rows, p, kind, bed);
}

template <int D>
void BufferedLine<D>::exchange(FieldSet& particles, const Bind<D>& bind, const Ground& bed, double t,
                               double dt, int& next_id) {
  section_.impose(law_(t), dt);
  for (auto& buffer : buffers_) {
    const Crossed crossed = buffer.convert(particles, bind(), bed);
    flow_.inflow += crossed.in;
    flow_.outflow += crossed.out;
  }
  for (auto& buffer : buffers_) buffer.insert(particles, bind, bed, next_id);
}

template <int D>
OpenFlow BufferedLine<D>::flow() const {
  OpenFlow flow = flow_;
  const OpenFlux flux = section_.flux();
  flow.flux = flux.net, flow.flux_gross = flux.gross;
  return flow;
}

template <int D>
double BufferedLine<D>::straddling(const Particles<D>& p, const Field<int>& kind, int n) const {
  double volume = 0;
  for (const auto& buffer : buffers_) volume += buffer.straddling(p, kind, n);
  return volume;
}

namespace {

// The doubles of a row's state, in order; visit(double&) each.
template <class Row, class Visit>
void each_value(Row& row, const Visit& visit) {
  for (auto* value : {&row.bed, &row.level, &row.speed, &row.slip, &row.still, &row.depth, &row.inward,
                      &row.along, &row.mean_speed, &row.mean_celerity, &row.through})
    visit(*value);
}

}  // namespace

template <int D>
std::vector<double> BufferedLine<D>::save() const {
  const OpenFlow passed = flow();
  std::vector<double> state{passed.inflow, passed.outflow, passed.flux, passed.flux_gross, passed.straddle0};
  for (const OpenRow& row : section_.states()) {
    each_value(row, [&](const double& value) { state.push_back(value); });
    state.push_back(row.wet);
    state.push_back(row.closed);
  }
  return state;
}

template <int D>
void BufferedLine<D>::restore(const std::vector<double>& state) {
  flow_ = {state.at(0), state.at(1), state.at(2), state.at(3), state.at(4)};
  size_t next = 5;
  std::vector<OpenRow> rows = section_.states();
  for (OpenRow& row : rows) {
    each_value(row, [&](double& value) { value = state.at(next++); });
    row.wet = state.at(next++) != 0;
    row.closed = state.at(next++) != 0;
  }
  section_.restore(rows, {flow_.flux, flow_.flux_gross});
}

template class BufferedLine<1>;
template class BufferedLine<2>;

}  // namespace freshet::swe
