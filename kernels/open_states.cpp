#include "kernels/open_states.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

double celerity(double depth, const OpenStrip& strip) { return std::sqrt(strip.gravity * std::max(0.0, depth)); }

// R, the invariant that leaves; a dry row has none, and 0 leads to critical inflow.
double leaving(const InnerState& inner, const OpenStrip& strip) { return 2 * celerity(inner.depth, strip) - inner.inward; }

bool leaves_supercritically(const InnerState& inner, const OpenStrip& strip) {
  return inner.depth > 0 && -inner.inward > celerity(inner.depth, strip);
}

ExteriorState copied(const InnerState& inner) { return {inner.depth, inner.inward, false}; }

// From the celerity instead of the depth.
ExteriorState state(double c, double inward, const OpenStrip& strip) { return {c * c / strip.gravity, inward, false}; }

// The most that can leave: u = -c with R kept.
ExteriorState critical_outflow(double r, const OpenStrip& strip) {
  const double c = std::max(0.0, r / 3);
  return state(c, -c, strip);
}

ExteriorState wall(double r, const OpenStrip& strip) {
  const double c = std::max(0.0, r / 2);
  return {c * c / strip.gravity, 0, true};
}

// The state at the line between an outer state with the invariant `entering` = u + 2 c and the inner one: where the rarefaction
// between them would be transonic, the line sees its critical point.
ExteriorState between(double entering, double r, const OpenStrip& strip) {
  const double c = (entering + r) / 4, u = (entering - r) / 2;
  if (u < -c) return critical_outflow(r, strip);
  if (u > c) {
    const double critical = std::max(0.0, entering / 3);
    return state(critical, critical, strip);
  }
  return state(c, u, strip);
}

// The root of 2 c^3 - r c^2 = gq right of the minimum of the left side, from a start above it: Newton falls on to it.
double cubic_root(double r, double gq, double start) {
  double c = start;
  for (int n = 0; n < 50; ++n) {
    const double slope = 6 * c * c - 2 * r * c;
    if (slope <= 0) break;
    const double step = (2 * c * c * c - r * c * c - gq) / slope;
    c -= step;
    if (std::abs(step) <= 1e-15 * c) break;
  }
  return c;
}

}  // namespace

ExteriorState ImposedLevel::operator()(const InnerState& inner, const OpenStrip& strip) const {
  if (leaves_supercritically(inner, strip)) return copied(inner);
  const double r = leaving(inner, strip), c = celerity(level - strip.bed, strip);
  if (c <= r / 3) return critical_outflow(r, strip);  // a free fall: the level outside is not felt
  return state(c, std::min(2 * c - r, c), strip);
}

ExteriorState IncomingWave::operator()(const InnerState& inner, const OpenStrip& strip) const {
  if (leaves_supercritically(inner, strip)) return copied(inner);
  const double entering = 4 * celerity(level - strip.bed, strip) - 2 * celerity(strip.still, strip);
  return between(entering, leaving(inner, strip), strip);
}

ExteriorState ImposedVelocity::operator()(const InnerState& inner, const OpenStrip& strip) const {
  const double r = leaving(inner, strip);
  if (inward == 0) return wall(r, strip);  // also before water that arrives supercritically
  if (inward < 0 && leaves_supercritically(inner, strip)) return copied(inner);
  const double c = (r + inward) / 2;
  if (inward < 0 && c < -inward) return critical_outflow(r, strip);
  return state(std::max(c, inward), inward, strip);
}

ExteriorState ImposedDischarge::operator()(const InnerState& inner, const OpenStrip& strip) const {
  const double r = leaving(inner, strip), gq = strip.gravity * total * strip.share;
  if (gq == 0) return wall(r, strip);
  if (gq > 0) {
    const double critical = std::cbrt(gq);
    const double c = inner.depth > 0 ? cubic_root(r, gq, std::max(r, 0.0) / 2 + std::cbrt(gq / 2)) : critical;
    return state(std::max(c, critical), gq / std::pow(std::max(c, critical), 2), strip);
  }
  if (inner.depth <= 0) return wall(0, strip);
  if (leaves_supercritically(inner, strip)) return copied(inner);
  if (r * r * r <= -27 * gq) return critical_outflow(r, strip);
  const double c = cubic_root(r, gq, r / 2);
  return state(c, gq / (c * c), strip);
}

ExteriorState ImposedState::operator()(const InnerState& inner, const OpenStrip& strip) const {
  const double outer = celerity(above_bed ? stage : stage - strip.bed, strip);
  if (outer > 0 && inward > outer) return state(outer, inward, strip);
  if (leaves_supercritically(inner, strip)) return copied(inner);
  return between((outer > 0 ? inward : 0) + 2 * outer, leaving(inner, strip), strip);
}

ExteriorState Transmissive::operator()(const InnerState& inner, const OpenStrip& strip) const {
  if (inner.depth <= 0 || leaves_supercritically(inner, strip)) return copied(inner);
  return between(inner.arriving, leaving(inner, strip), strip);
}

ExteriorState exterior_state(const OpenLaw& law, const InnerState& inner, const OpenStrip& strip) {
  return std::visit([&](const auto& kind) { return kind(inner, strip); }, law);
}

std::vector<double> discharge_shares(const std::vector<Portion>& rows, bool by_width) {
  double wet_width = 0, level = 0, width = 0, conveyance = 0;
  for (const Portion& row : rows) {
    width += row.width;
    if (row.wet) wet_width += row.width, level += row.width * row.level;
  }
  std::vector<double> shares(rows.size(), 1 / width);
  if (by_width || wet_width == 0) return shares;
  level /= wet_width;
  for (size_t r = 0; r < rows.size(); ++r) {
    shares[r] = std::pow(std::max(0.0, level - rows[r].bed), 5.0 / 3);
    conveyance += shares[r] * rows[r].width;
  }
  for (double& share : shares) share = conveyance > 0 ? share / conveyance : 1 / width;
  return shares;
}

}  // namespace freshet
