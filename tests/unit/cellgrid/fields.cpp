// Particle fields on request.
#include "cellgrid/particles/fields.hpp"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace freshet;

namespace {

void fill(const Field<double>& field, int n, double first) {
  for (int i = 0; i < n; ++i) field(i) = first + i;
}

Input<int> reversed(int n) {
  Field<int> order("order", static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) order(i) = n - 1 - i;
  return order;
}

// How many of the first n values differ from what is expected.
template <class View, class Expected>
int wrong(const View& field, int n, const Expected& expected) {
  int count = 0;
  for (int i = 0; i < n; ++i) count += field(i) != expected(i);
  return count;
}

}  // namespace

TEST_CASE("fields: made on request, zero-filled, found again") {
  FieldSet f(5);
  CHECK(f.reals().empty());
  CHECK_FALSE(f.has("depth"));
  const auto depth = f.real("depth", "m", Carry::state);
  const auto id = f.integer("id", "1", Carry::state);
  CHECK(f.has("depth"));
  CHECK(f.has("id"));
  CHECK(wrong(depth, 5, [](int) { return 0; }) == 0);
  CHECK(wrong(id, 5, [](int) { return 0; }) == 0);
  CHECK(f.real("depth").data() == depth.data());
  CHECK(f.real("depth", "km", Carry::no).data() == depth.data());  // the first request counts
  REQUIRE(f.reals().size() == 1);
  CHECK(f.reals()[0].unit == "m");
  CHECK(f.reals()[0].carry == Carry::state);
}

TEST_CASE("fields: an unknown name is an error that says which") {
  FieldSet f(3);
  f.real("x", "m", Carry::sort);
  f.integer("id", "1", Carry::sort);
  CHECK_THROWS_AS(f.real("y"), std::logic_error);
  CHECK_THROWS_AS(f.integer("x"), std::logic_error);  // of the other type
  CHECK_THROWS_AS(f.real("id"), std::logic_error);
  CHECK_THROWS_WITH(f.real("y"), Catch::Contains("'y'"));
}

TEST_CASE("fields: growth keeps values, shrinking keeps storage") {
  FieldSet f(10);
  fill(f.real("a", "m", Carry::state), 10, 100);
  fill(f.real("scratch", "m", Carry::no), 10, 200);
  const auto id = f.integer("id", "1", Carry::state);
  for (int i = 0; i < 10; ++i) id(i) = 7 * i;
  f.resize(5000);
  CHECK(f.size() == 5000);
  CHECK(f.capacity() >= 5000);
  CHECK(f.real("a").extent_int(0) >= 5000);
  CHECK(f.integer("id").extent_int(0) >= 5000);
  CHECK(wrong(f.real("a"), 10, [](int i) { return 100 + i; }) == 0);
  CHECK(wrong(f.real("scratch"), 10, [](int i) { return 200 + i; }) == 0);
  CHECK(wrong(f.integer("id"), 10, [](int i) { return 7 * i; }) == 0);
  const double* before = f.real("a").data();
  const int capacity = f.capacity();
  f.resize(3);
  f.resize(capacity);
  CHECK(f.real("a").data() == before);
  CHECK(f.capacity() == capacity);
}

TEST_CASE("fields: growing one by one allocates a few times only") {
  FieldSet f(0);
  f.real("a", "m", Carry::state);
  int moves = 0;
  for (int n = 1; n <= 10000; ++n) {
    const double* before = f.real("a").data();
    f.resize(n);
    f.real("a")(n - 1) = n;
    moves += f.real("a").data() != before;
  }
  CHECK(moves <= 13);  // by half each time from 64 on: log(10000 / 64) / log(1.5) = 12.5
  CHECK(wrong(f.real("a"), 10000, [](int i) { return i + 1; }) == 0);
}

TEST_CASE("fields: only what belongs to a particle is permuted") {
  constexpr int n = 20;
  FieldSet f(n);
  fill(f.real("state", "m", Carry::state), n, 0);
  fill(f.real("scratch", "m", Carry::no), n, 1000);
  fill(f.real("sorted", "m", Carry::sort), n, 2000);
  fill(f.real("result", "m", Carry::result), n, 3000);
  const auto id = f.integer("id", "1", Carry::state), other = f.integer("other", "1", Carry::no);
  for (int i = 0; i < n; ++i) id(i) = other(i) = i;
  f.permute(reversed(n), n);
  CHECK(wrong(f.real("state"), n, [](int i) { return n - 1 - i; }) == 0);
  CHECK(wrong(f.real("scratch"), n, [](int i) { return 1000 + i; }) == 0);
  CHECK(wrong(f.real("sorted"), n, [](int i) { return 2000 + n - 1 - i; }) == 0);
  CHECK(wrong(f.real("result"), n, [](int i) { return 3000 + i; }) == 0);
  CHECK(wrong(f.integer("id"), n, [](int i) { return n - 1 - i; }) == 0);
  CHECK(wrong(f.integer("other"), n, [](int i) { return i; }) == 0);
}

TEST_CASE("fields: growth between two permutations loses nothing") {
  FieldSet f(8);
  fill(f.real("a", "m", Carry::state), 8, 0);
  fill(f.real("b", "m", Carry::sort), 8, 50);
  f.permute(reversed(8), 8);
  f.resize(400);  // the spare storage is now too short
  for (int i = 8; i < 400; ++i) f.real("a")(i) = i;
  f.permute(reversed(400), 400);
  CHECK(wrong(f.real("a"), 392, [](int i) { return 399 - i; }) == 0);
  CHECK(f.real("a")(399) == 7);
  CHECK(f.real("b")(399) == 57);
  CHECK(f.real("a").data() != f.real("b").data());
}

TEST_CASE("fields: what is sorted and what is saved") {
  CHECK(is_sorted(Carry::sort));
  CHECK(is_sorted(Carry::state));
  CHECK_FALSE(is_sorted(Carry::no));
  CHECK_FALSE(is_sorted(Carry::result));
  CHECK(is_saved(Carry::state));
  CHECK(is_saved(Carry::result));
  CHECK_FALSE(is_saved(Carry::no));
  CHECK_FALSE(is_saved(Carry::sort));
}
