// Sums over particles that do not depend on the order of the terms, so neither on threads, chunks, lanes nor
// who stands where: every term is cut at fixed places into integers of 32 bits, and integers are added. What
// is cut off lies below 2^-64 of the largest term (a double's own rounding is 2^-53 of each).
#pragma once
#include <cmath>
#include <utility>

#include "cellgrid/particles/clusters.hpp"

namespace freshet {

// A sum as three integers, in units of 2^(32 top), 2^(32 (top - 1)) and 2^(32 (top - 2)). top: the place of
// the largest term so far. Exact for 1e9 terms. Terms of 2^959 and more count as infinite, what lies below
// 2^-928 as zero.
class IntegerSum {
 public:
  static constexpr int bits = 32, parts = 3, lowest = -27, highest = 29;

  // 2^(32 place)
  static KOKKOS_FORCEINLINE_FUNCTION double unit(int place) {
    const long long pattern = static_cast<long long>(bits * place + 1023) << 52;
    double value;
    __builtin_memcpy(&value, &pattern, sizeof value);
    return value;
  }
  // The place at which a term begins: |term| < unit(place + 1) / 2, so that from a higher place it is rounded
  // to nothing there, which is what is left of it where a larger term comes later.
  static KOKKOS_FORCEINLINE_FUNCTION int place_of(double term) {
    long long pattern;
    __builtin_memcpy(&pattern, &term, sizeof pattern);
    const int exponent = static_cast<int>(pattern >> 52 & 0x7ff);  // biased by 1023 = 32 x 32 - 1
    return larger((exponent + 2) / bits - 32, lowest);
  }
  static KOKKOS_FORCEINLINE_FUNCTION bool is_finite(double term) { return size_of(term) < largest(); }
  static KOKKOS_FORCEINLINE_FUNCTION double largest() { return 0.5 * unit(highest + 1); }

  KOKKOS_INLINE_FUNCTION int top() const { return top_; }
  // Multiples of the part's unit, in each lane.
  KOKKOS_INLINE_FUNCTION void add(int part, Lane multiples) {
    for_each_lane(multiples * unit(part - top_),
                  [&](int, double units) { part_[part] += static_cast<long long>(units); });
  }
  KOKKOS_INLINE_FUNCTION void add_not_finite(double term) {
    odd_ += term < 0 ? -HUGE_VAL : term > 0 ? HUGE_VAL : term;
  }

  // Parts that lie too low for the new place are forgotten, of every term alike.
  KOKKOS_INLINE_FUNCTION void raise(int place) {
    const int steps = smaller(place - top_, parts);
    if (steps <= 0) return;
    for (int k = parts - 1; k >= 0; --k) part_[k] = k >= steps ? part_[k - steps] : 0;
    top_ = place;
  }
  KOKKOS_INLINE_FUNCTION void add(const IntegerSum& other) {
    raise(other.top_);
    for (int k = 0; k + top_ - other.top_ < parts; ++k) part_[k + top_ - other.top_] += other.part_[k];
    odd_ += other.odd_;
  }

  // Rounded once or twice; infinite or NaN where a term was.
  double value() const {
    long long digit[parts] = {part_[0], part_[1], part_[2]};
    for (int k = parts - 1; k > 0;
         --k) {  // digits of -2^31 ... 2^31: what leads is then larger than what follows
      const long long carry = (digit[k] + (1ll << (bits - 1))) >> bits;
      digit[k] -= carry * (1ll << bits);
      digit[k - 1] += carry;
    }
    double sum = 0;
    for (int k = parts - 1; k >= 0; --k) sum += static_cast<double>(digit[k]) * unit(top_ - k);
    return sum + odd_;
  }

 private:
  long long part_[parts] = {0, 0, 0};
  double odd_ = 0;  // the sum of terms that are not finite
  int top_ = lowest;
};

// The terms of some slices in a row, lane by lane: in doubles, which hold the integers of 2^20 slices
// exactly. A value without arrays, of which no address is taken: it stays in registers.
struct LaneSum {
  double limit;  // what terms are smaller than
  Lane high, middle, low;

  static KOKKOS_FORCEINLINE_FUNCTION LaneSum from(int top) {
    return {0.5 * IntegerSum::unit(top + 1), Lane(0.0), Lane(0.0), Lane(0.0)};
  }
  KOKKOS_FORCEINLINE_FUNCTION void end(IntegerSum& total) const {
    total.add(0, high);
    total.add(1, middle);
    total.add(2, low);
  }
};

// Takes from the term its nearest multiple of 2^-52 2/3 shift, and returns that.
KOKKOS_FORCEINLINE_FUNCTION Lane taken_from(Lane& term, double shift) {
  const Lane multiple = (term + shift) - shift;
  term -= multiple;
  return multiple;
}

// |term| < sum.limit
KOKKOS_FORCEINLINE_FUNCTION LaneSum added(const LaneSum sum, Lane term) {
  constexpr double per_part = 0x1p-32;
  const double shift = 0x1.8p53 * per_part * sum.limit;  // 3/2 2^52 of the highest part's unit
  const Lane high = taken_from(term, shift), middle = taken_from(term, per_part * shift);
  return {sum.limit, sum.high + high, sum.middle + middle,
          sum.low + taken_from(term, per_part * per_part * shift)};
}

// Makes room for a term larger than any before; what is not finite goes elsewhere.
FRESHET_OUT_OF_LINE KOKKOS_INLINE_FUNCTION LaneSum added_anew(const LaneSum sum, IntegerSum& total,
                                                              Lane term) {
  sum.end(total);
  Lane finite(0.0);
  for_each_lane(term, [&](int lane, double one) {
    if (!IntegerSum::is_finite(one)) return total.add_not_finite(one);
    total.raise(IntegerSum::place_of(one));
    set_lane(finite, lane, one);
  });
  return added(LaneSum::from(total.top()), finite);
}

// The term as a number of its own: a product that is rounded to units at once would leave another rest than a
// double's.
KOKKOS_FORCEINLINE_FUNCTION LaneSum added(const LaneSum sum, IntegerSum& total, Lane term) {
  term = rounded(term);
  if (any(!(size_of(term) < Lane(sum.limit)))) {
    const LaneSum larger = added_anew(sum, total, term);
    return {larger.limit, larger.high, larger.middle, larger.low};
  }
  return added(sum, term);
}

// K sums at once, and how Kokkos joins those of threads.
template <int K>
struct IntegerSums {
  IntegerSum of[K];
};
template <int K>
struct JoinedSums {
  using reducer = JoinedSums;
  using value_type = IntegerSums<K>;
  using result_view_type = Kokkos::View<value_type, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>;
  value_type* result;

  KOKKOS_INLINE_FUNCTION void join(value_type& to, const value_type& from) const {
    for (int k = 0; k < K; ++k) to.of[k].add(from.of[k]);
  }
  // Kokkos 3 passes what it joins as volatile; no other thread looks at it.
  KOKKOS_INLINE_FUNCTION void join(volatile value_type& to, const volatile value_type& from) const {
    join(const_cast<value_type&>(to), const_cast<const value_type&>(from));
  }
  KOKKOS_INLINE_FUNCTION void init(value_type& value) const { value = value_type(); }
  KOKKOS_INLINE_FUNCTION value_type& reference() const { return *result; }
  KOKKOS_INLINE_FUNCTION result_view_type view() const { return result_view_type(result); }
  KOKKOS_INLINE_FUNCTION bool references_scalar() const { return true; }
};

// K terms, or their sums, and those of a slice's particles.
template <int K>
using Addends = Kokkos::Array<double, K>;
template <int K>
using LaneAddends = Kokkos::Array<Lane, K>;

// each(i) returns the Addends<K> of particle i.
template <int K, class Each>
KOKKOS_FORCEINLINE_FUNCTION LaneAddends<K> addends_of(const Lanes& me, const Each& each) {
  double term[K][lanes] = {};
  for (int lane = 0; lane < me.count; ++lane) {
    const Addends<K> one = each(me.first + lane);
    for (int k = 0; k < K; ++k) term[k][lane] = one[k];
  }
  LaneAddends<K> terms;
  for (int k = 0; k < K; ++k) terms[k] = loaded<Lane>(term[k]);
  return terms;
}

// The terms of particles 0 ... n - 1 by slices, of one call for a slice's particles together or of one for
// each.
template <int K, class Values>
struct AddendsTogether {
  Values values;
  int n;
  KOKKOS_FORCEINLINE_FUNCTION LaneAddends<K> operator()(int s) const {
    const Lanes me = block(s, n);
    return counted(me, values(me), std::make_integer_sequence<int, K>());
  }
  template <int... k>
  static KOKKOS_FORCEINLINE_FUNCTION LaneAddends<K> counted(const Lanes& me, const LaneAddends<K>& terms,
                                                            std::integer_sequence<int, k...>) {
    return {{freshet::counted(me, terms[k])...}};
  }
};
template <int K, class Values>
struct AddendsApart {
  Values values;
  int n;
  KOKKOS_FORCEINLINE_FUNCTION LaneAddends<K> operator()(int s) const {
    return addends_of<K>(block(s, n), values);
  }
};

// K of those.
template <int K>
struct LaneSums {
  LaneSum here;
  LaneSums<K - 1> rest;

  static KOKKOS_FORCEINLINE_FUNCTION LaneSums from(const IntegerSum* total) {
    return {LaneSum::from(total->top()), LaneSums<K - 1>::from(total + 1)};
  }
  KOKKOS_FORCEINLINE_FUNCTION LaneSums plus(IntegerSum* total, const Lane* term) const {
    return {added(here, *total, *term), rest.plus(total + 1, term + 1)};
  }
  KOKKOS_FORCEINLINE_FUNCTION void end(IntegerSum* total) const {
    here.end(*total);
    rest.end(total + 1);
  }
};
template <>
struct LaneSums<0> {
  static KOKKOS_FORCEINLINE_FUNCTION LaneSums from(const IntegerSum*) { return {}; }
  KOKKOS_FORCEINLINE_FUNCTION LaneSums plus(IntegerSum*, const Lane*) const { return {}; }
  KOKKOS_FORCEINLINE_FUNCTION void end(IntegerSum*) const {}
};

// A row of slices that one thread sums.
template <int K, class Values>
struct SumOfSlices {
  static constexpr int row = lanes > 1 ? 64 : 512;
  Values values;
  int slices;

  KOKKOS_FUNCTION void operator()(int r, IntegerSums<K>& total) const {
    LaneSums<K> sum = LaneSums<K>::from(total.of);
    const int end = smaller((r + 1) * row, slices);
    for (int s = r * row; s < end; ++s) {
      const LaneAddends<K> terms = values(s);
      sum = sum.plus(total.of, &terms[0]);
    }
    sum.end(total.of);
  }
};

#ifdef FRESHET_DEVICE
template <int K, class Pass>
IntegerSums<K> sum_of_rows(const char* label, int rows, const Pass& pass) {
  IntegerSums<K> total;
  Kokkos::parallel_reduce(label, Range(0, rows), pass, JoinedSums<K>{&total});
  return total;
}
#else
// A row's sum without its type: Kokkos' machinery is compiled once for each K (1 ... 4).
template <int K>
struct AnyRow {
  void (*add)(const void* pass, int row, IntegerSums<K>& total);
  const void* pass;
};
template <int K>
IntegerSums<K> sum_of_any_rows(const char* label, int rows, const AnyRow<K>& row);

template <int K, class Pass>
IntegerSums<K> sum_of_rows(const char* label, int rows, const Pass& pass) {
  const auto add = [](const void* of, int row, IntegerSums<K>& total) {
    (*static_cast<const Pass*>(of))(row, total);
  };
  return sum_of_any_rows<K>(label, rows, {add, &pass});
}
#endif

// values(s) returns the LaneAddends<K> of slice s, zero in lanes that do not count (see counted). What it
// writes on the way makes one fused pass. Waits for the result.
template <int K, class Values>
Addends<K> sum_of_slices(const char* label, int slices, const Values& values) {
  using Pass = SumOfSlices<K, Values>;
  const IntegerSums<K> total =
      sum_of_rows<K>(label, (slices + Pass::row - 1) / Pass::row, Pass{values, slices});
  Addends<K> result;
  for (int k = 0; k < K; ++k) result[k] = total.of[k].value();
  return result;
}

// Likewise of particles 0 ... n - 1: values(me) returns LaneAddends<K> of a slice's particles, or values(i)
// the Addends<K> of one.
template <int K, class Values>
Addends<K> sum_of_particles(const char* label, int n, const Values& values) {
  if constexpr (std::is_invocable_v<Values, Lanes>)
    return sum_of_slices<K>(label, blocks(n), AddendsTogether<K, Values>{values, n});
  else return sum_of_slices<K>(label, blocks(n), AddendsApart<K, Values>{values, n});
}

// The sum of values 0 ... n - 1.
double sum_of_values(const char* label, int n, const Field<double>& values);

}  // namespace freshet
