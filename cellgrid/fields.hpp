// Structure-of-arrays particle fields, made on request: what nobody asks for is never allocated, sorted or saved.
#pragma once
#include <string>
#include <vector>

#include "cellgrid/vec.hpp"

namespace freshet {

enum class Carry {
  no,      // scratch of one step: neither sorted nor saved
  sort,    // belongs to its particle: permuted by the sort
  state,   // as sort, and part of the restart state
  result   // made anew after each sort: not permuted, but part of the restart state
};
inline bool is_sorted(Carry c) { return c == Carry::sort || c == Carry::state; }
inline bool is_saved(Carry c) { return c == Carry::state || c == Carry::result; }

template <class T>
struct NamedField {
  std::string name;
  std::string unit;  // SI, "m", "m/s", "1"
  Carry carry;
  Field<T> data;  // capacity() values, of which the first size() are particles
};

class FieldSet {
 public:
  explicit FieldSet(int size = 0);

  int size() const { return size_; }
  int capacity() const { return capacity_; }

  // Changes the particle count. Existing values stay; the capacity grows by half when it is too small (the only
  // allocation that a step may cause). Views obtained before a growth are stale: ask again.
  void resize(int size);

  // Makes the field of that name, zero-filled; where it exists already that one is returned.
  Field<double> real(const std::string& name, const std::string& unit, Carry carry);
  Field<int> integer(const std::string& name, const std::string& unit, Carry carry);

  // The field of that name; throws std::logic_error if nobody made it.
  Field<double> real(const std::string& name) const;
  Field<int> integer(const std::string& name) const;

  bool has(const std::string& name) const;

  // The same, or nullptr.
  const NamedField<double>* find_real(const std::string& name) const;
  const NamedField<int>* find_integer(const std::string& name) const;

  // The field of that name, or an empty one if nobody made it.
  Field<double> real_or_none(const std::string& name) const;
  Field<int> integer_or_none(const std::string& name) const;

  // Both components of a vector; in 1-D there is one.
  template <int D>
  VecField<double, D> vector(const char* x, const char* y) const {
    if constexpr (D == 1) return {real(x)};
    else return {real(x), real(y)};
  }

  // Every sorted field becomes field[order[i]] for i < size.
  void permute(const Input<int>& order, int size);

  // Appends count particles, copies of from[k] in every sorted field.
  void append_copies(const Input<int>& from, int count);

  const std::vector<NamedField<double>>& reals() const { return reals_; }
  const std::vector<NamedField<int>>& integers() const { return integers_; }

 private:
  int size_ = 0, capacity_ = 0;
  std::vector<NamedField<double>> reals_;
  std::vector<NamedField<int>> integers_;
  Field<double> spare_real_;
  Field<int> spare_integer_;
};

}  // namespace freshet
