// What tests of open boundaries look at: the fluid's spread, the account of mass, pulses.
#pragma once
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

namespace freshet::test {

inline Series constant(double value) { return {{0}, {value}}; }

inline constexpr double amplitude = 0.02;  // m, of pulses on 1 m

inline double pulse(double r) { return amplitude * std::exp(-r * r / 4); }

struct Spread {
  double lowest = 1e9, highest = -1e9;
  void add(double value) { lowest = std::min(lowest, value), highest = std::max(highest, value); }
};

// Of the fluid from x = low to high.
inline Spread of_fluid(const Flow& flow, const char* name, double low = -1e9, double high = 1e9) {
  const auto kind = std::as_const(*flow.method).fields().integer("kind");
  Spread s;
  for (int i = 0; i < flow.size(); ++i)
    if (kind(i) == 0 && flow.real("x")(i) > low && flow.real("x")(i) < high) s.add(flow.real(name)(i));
  return s;
}

inline void check_books(const Flow& flow, double initial) {
  const Totals t = flow.method->totals();
  CHECK(std::abs(t.mass - initial - t.inflow + t.outflow) <= 1e-12 * std::max(initial, t.inflow));
}

}  // namespace freshet::test
