// What a scene does not name is neither launched nor allocated.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/support/watch/skips.hpp"

using namespace freshet;
using test::bare_step, test::drop, test::extra_labels, test::field_names, test::minus, test::Names,
    test::sorted_fields;
using test::Flow;
using test::Recording;

TEST_CASE("skips: a bare scene launches exactly its passes, in order") {
  Flow flow(drop());
  flow.many_steps(5);
  const long rebuilds = flow.method->report().rebuilds;
  const Recording recording;
  flow.many_steps(1);
  REQUIRE(flow.method->report().rebuilds == rebuilds);  // else lists and densities are launched again
  CHECK(recording.launches == bare_step(sorted_fields(flow.method->fields())));
}

TEST_CASE("skips: stable_dt launches nothing") {
  Flow flow(drop());
  const Recording recording;
  CHECK(flow.method->stable_dt() > 0);
  CHECK(recording.launches.empty());
}

TEST_CASE("skips: a step allocates nothing after the first ones") {
  Flow flow(drop());
  flow.many_steps(3);
  const Recording recording;
  flow.many_steps(7);  // the drop grows by 13 %, its cells by 26 %: storage has half its size to spare
  CHECK(recording.launches.size() > 20);
  CHECK(recording.allocations == std::vector<std::string>{});
}

TEST_CASE("skips: walls and open boundaries allocate nothing inside a step either") {
  Scene scene = test::bare_scene(2, {0, 0}, {1.2, 0.4}, 0.05);
  scene.water.depth = [](double x, double) { return 0.3 + 0.02 * x; };
  if (GENERATE(false, true)) test::open_left(scene, IncomingWave{}, {{0}, {0.3}});
  else test::close_box(scene);
  CAPTURE(scene.boundaries.size());
  Flow flow(scene);
  flow.many_steps(10);
  const Recording recording;
  flow.many_steps(20);
  CHECK(recording.launches.size() > 20);
  CHECK(recording.allocations == std::vector<std::string>{});
}

TEST_CASE("skips: a spreading drop allocates a few times only, as its storage grows by half") {
  Flow flow(drop());
  flow.many_steps(10);
  const Recording recording;
  flow.many_steps(20);
  std::map<std::string, int> count;
  for (const auto& label : recording.allocations) ++count[label];
  for (const auto& [label, times] : count) {
    CAPTURE(label);
    CHECK(times <= 5);  // 2.5 times the diameter, 6 times the cells: log(6)/log(1.5) = 4.4 enlargements
  }
}

TEST_CASE("skips: fields come with the features that need them") {
  const Names bare = field_names(drop());
  for (const char* name : {"bed", "drag", "kind"}) CHECK(bare.count(name) == 0);
  CHECK(bare.count("strain_xx") == 1);  // MUSCL is the default

  Scene scene = drop();
  scene.sph.stabilisation = swe::LaxFriedrichs{};
  CHECK(minus(bare, field_names(scene)) == Names{"strain_xx", "strain_xy", "strain_yy"});

  scene = drop();
  scene.bed.elevation = [](double x, double) { return 0.01 * x; };
  CHECK(minus(field_names(scene), bare) == Names{"bed"});

  scene = drop();
  scene.manning = 0.01;
  CHECK(minus(field_names(scene), bare) == Names{"drag"});

  scene = drop();
  test::close_box(scene);
  CHECK(field_names(scene) == bare);  // walls have points of their own

  scene = drop();
  test::open_left(scene, IncomingWave{}, {{0}, {0.1}});
  CHECK(minus(field_names(scene), bare) == Names{"kind"});
}

TEST_CASE("skips: launches come with the features that need them") {
  CHECK(extra_labels(drop()) == Names{});

  Scene scene = drop();
  scene.bed.elevation = [](double x, double) { return 0.01 * x; };
  scene.manning = 0.01;
  CHECK(extra_labels(scene) == Names{});  // bed and friction are part of the O(N) passes

  scene = drop();
  test::close_box(scene);
  CHECK(extra_labels(scene) == Names{"walls::felt_h", "walls::list", "walls::reflect"});

  scene = drop();
  test::open_left(scene, IncomingWave{}, {{0}, {0.1}});
  scene.walls.clear();
  const Names opened = extra_labels(scene);
  CHECK(opened.count("open::convert") == 1);
  for (const auto& label : opened) {
    CAPTURE(label);
    CHECK(label.substr(0, 6) == "open::");
  }
}

TEST_CASE(
    "skips: splitting and merging need no field, and where nothing is to do few launches and no memory") {
  Scene scene = drop();
  const Names bare = field_names(scene);
  scene.split = Split{};
  scene.split->alpha = 0.92, scene.split->eps = 0.36;
  scene.split->area.elsewhere = 1e3;
  CHECK(field_names(scene) == bare);
  CHECK(extra_labels(scene) == Names{"split::choose", "refine::relax"});
  scene.split.reset();
  scene.merge = Merge{};
  scene.merge->area.elsewhere = 1e-3;
  CHECK(field_names(scene) == bare);
  CHECK(extra_labels(scene) == Names{"merge::eligible", "merge::choose", "merge::join", "refine::relax"});
  Flow flow(scene);
  flow.many_steps(3);
  const Recording recording;
  flow.many_steps(3);
  CHECK(recording.allocations == std::vector<std::string>{});
}

TEST_CASE("skips: one number for Manning's n makes no table, a map makes one and adds no launch") {
  Scene scene = drop();
  scene.manning = 0.03;
  const auto tables = [](const Scene& of) {
    const Recording recording;
    const Flow flow(of);
    return std::count(recording.allocations.begin(), recording.allocations.end(), "ground.table");
  };
  CHECK(tables(scene) == 0);
  scene.manning->map = [](double x, double) { return x < 0 ? 0.02 : 0.05; };
  scene.manning->step = {0.05, 0.05};
  CHECK(tables(scene) == 1);
  CHECK(extra_labels(scene) == Names{});
}

TEST_CASE("skips: the curvature of a bed is looked up only where it matters") {
  Scene scene = drop();
  const auto described = [&](double slope, Acceleration acceleration) {
    scene.sph.acceleration = acceleration;
    scene.bed.elevation = [slope](double x, double) { return slope * std::sin(x); };
    const Flow flow(scene);
    const auto names = flow.method->features();
    return std::count(names.begin(), names.end(), "bed, variational acceleration") == 1;
  };
  CHECK(described(0.1, Acceleration::variational));
  CHECK_FALSE(described(0.1, Acceleration::classical));
  CHECK_FALSE(described(0.9e-3, Acceleration::variational));
}

TEST_CASE("skips: no roughness is no friction to the bit") {
  Scene plain = drop(), smooth = drop();
  plain.bed.elevation =
      smooth.bed.elevation = [](double x, double y) { return 0.1 * x * x + 0.05 * std::sin(3 * y); };
  smooth.manning = 0;
  Flow a(plain), b(smooth);
  a.many_steps(60), b.many_steps(60);
  CHECK(a.t == b.t);
  for (const char* name : {"x", "y", "u", "v", "depth", "h", "mass"}) {
    CAPTURE(name);
    CHECK((a.by_id(name) == b.by_id(name)));
  }
}
