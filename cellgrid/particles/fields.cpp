#include "cellgrid/particles/fields.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "cellgrid/parallel/launch.hpp"

namespace freshet {
namespace {

// Vector loads may read past the last particle, never past the padding.
constexpr int padding = 16;

// Cache lines of a page: where in one a field begins decides which lines of a first-level cache it falls on.
constexpr std::uintptr_t line = 64, lines = 64;

// The cache line in its page at which particle 0 of the place-th field stands, each at another: large
// allocations all begin at the same one, and a pair loop that reads eleven fields at one j then has room for
// eight (force 10 to 40 % slower, docs/log/performance.md).
std::uintptr_t first_line(std::size_t place) { return 37 * place % lines; }
template <class T>
std::uintptr_t line_of(const Field<T>& field) {
  return reinterpret_cast<std::uintptr_t>(field.data()) / line % lines;
}

template <class T>
Field<T> allocate(const std::string& label, int capacity, std::uintptr_t wanted_line) {
  const std::size_t room = static_cast<std::size_t>(capacity + padding);
  const Field<T> all(label, room + lines * line / sizeof(T));
  const std::size_t skipped = (lines + wanted_line - line_of(all)) % lines * line / sizeof(T);
  return Kokkos::subview(all, std::make_pair(skipped, skipped + room));
}

template <class T>
void grow(Field<T>& field, int size, int capacity) {
  Field<T> larger_field = allocate<T>(field.label(), capacity, line_of(field));
  const auto kept = std::make_pair(0, size);
  Kokkos::deep_copy(Kokkos::subview(larger_field, kept), Kokkos::subview(field, kept));
  field = larger_field;
}

template <class T>
const NamedField<T>* find(const std::vector<NamedField<T>>& fields, const std::string& name) {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

template <class T>
Field<T> find_made(const std::vector<NamedField<T>>& fields, const std::string& name) {
  if (const NamedField<T>* known = find(fields, name)) return known->data;
  throw std::logic_error("no particle field is called '" + name + "'");
}

template <class T>
Field<T> find_or_make(std::vector<NamedField<T>>& fields, const std::string& name, const std::string& unit,
                      Carry carry, int capacity, std::size_t place) {
  if (const NamedField<T>* known = find(fields, name)) return known->data;
  fields.push_back({name, unit, carry, allocate<T>(name, capacity, first_line(place))});
  return fields.back().data;
}

template <class T>
void permute_all(std::vector<NamedField<T>>& fields, Field<T>& spare, const Input<int>& order, int size,
                 int capacity) {
  if (fields.empty()) return;
  if (spare.extent_int(0) < capacity + padding)
    spare = allocate<T>("spare", capacity, first_line(fields.size()));
  for (NamedField<T>& f : fields) {
    if (!is_sorted(f.carry)) continue;
    const Field<T> from = f.data, to = spare;
    launch(
        "cellgrid::permute", Range(0, size), KOKKOS_LAMBDA(int i) { to(i) = from(order(i)); });
    std::swap(f.data, spare);
  }
}

template <class T>
void copy_all(const std::vector<NamedField<T>>& fields, const Input<int>& from, int first, int count) {
  for (const NamedField<T>& f : fields) {
    if (!is_sorted(f.carry)) continue;
    const Field<T> data = f.data;
    launch(
        "cellgrid::copy", Range(0, count), KOKKOS_LAMBDA(int k) { data(first + k) = data(from(k)); });
  }
}

}  // namespace

FieldSet::FieldSet(int size) : size_(size), capacity_(size) {}

void FieldSet::resize(int size) {
  if (size > capacity_) {
    capacity_ = size + size / 2 + 64;
    for (auto& f : reals_) grow(f.data, size_, capacity_);
    for (auto& f : integers_) grow(f.data, size_, capacity_);
  }
  size_ = size;
}

Field<double> FieldSet::real(const std::string& name, const std::string& unit, Carry carry) {
  return find_or_make(reals_, name, unit, carry, capacity_, reals_.size());
}

Field<int> FieldSet::integer(const std::string& name, const std::string& unit, Carry carry) {
  return find_or_make(integers_, name, unit, carry, capacity_, integers_.size());
}

Field<double> FieldSet::real(const std::string& name) const { return find_made(reals_, name); }
Field<int> FieldSet::integer(const std::string& name) const { return find_made(integers_, name); }

Field<int> FieldSet::integer_or_none(const std::string& name) const {
  const NamedField<int>* known = find_integer(name);
  return known ? known->data : Field<int>();
}

Field<double> FieldSet::real_or(const std::string& name, const std::string& otherwise) const {
  return real(has(name) ? name : otherwise);
}
const NamedField<double>* FieldSet::find_real(const std::string& name) const { return find(reals_, name); }
const NamedField<int>* FieldSet::find_integer(const std::string& name) const { return find(integers_, name); }

bool FieldSet::has(const std::string& name) const { return find_real(name) || find_integer(name); }

void FieldSet::append_copies(const Input<int>& from, int count) {
  const int first = size_;
  resize(first + count);
  copy_all(reals_, from, first, count);
  copy_all(integers_, from, first, count);
}

void FieldSet::permute(const Input<int>& order, int size) {
  permute_all(reals_, spare_real_, order, size, capacity_);
  permute_all(integers_, spare_integer_, order, size, capacity_);
}

}  // namespace freshet
