// Structure-of-arrays particle fields, made on request: what nobody asks for is never allocated, sorted or
// saved.
#pragma once
#include <string>
#include <vector>

#include "cellgrid/simd/vec.hpp"

namespace freshet {

enum class Carry {
  no,     // scratch of one step: neither sorted nor saved
  sort,   // belongs to its particle: permuted by the sort
  state,  // as sort, and part of the restart state
  result  // made anew after each sort: not permuted, but part of the restart state
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

  // Changes the particle count. Existing values stay; the capacity grows by half when it is too small (the
  // only allocation that a step may cause). Views obtained before a growth are stale: ask again.
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

  Field<int> integer_or_none(const std::string& name) const;  // or an empty one
  Field<double> real_or(const std::string& name, const std::string& otherwise) const;

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

// What a struct of fields declares its members to: each with its names, its unit and how it is carried.
class FieldList {
 public:
  static FieldList making(FieldSet& set) { return {set, &set}; }
  static FieldList binding(const FieldSet& set) { return {set, nullptr}; }  // to fields that were made

  void operator()(Field<double>& member, const char* name, const char* unit, Carry carry) const {
    member = made_ ? made_->real(name, unit, carry) : set_.real(name);
  }
  void operator()(Field<int>& member, const char* name, const char* unit, Carry carry) const {
    member = made_ ? made_->integer(name, unit, carry) : set_.integer(name);
  }
  template <class T, int D>
  void operator()(VecField<T, D>& member, const char* x, const char* y, const char* unit, Carry carry) const {
    (*this)(member.x, x, unit, carry);
    if constexpr (D == 2) (*this)(member.y, y, unit, carry);
  }

 private:
  FieldList(const FieldSet& set, FieldSet* made) : set_(set), made_(made) {}

  const FieldSet& set_;
  FieldSet* made_;
};

}  // namespace freshet
