// The scenes of cases/ are valid and say what their comments promise.
#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

#include "src/reference/exact.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;

namespace {

#ifdef FRESHET_SOURCE_DIR
const std::string cases = std::string(FRESHET_SOURCE_DIR) + "/cases/";
#else
const std::string cases = "cases/";  // tests run in the checkout
#endif

// Cell-centred particles that are wet at the start.
int wet_cells(const Scene& scene) {
  const Domain& domain = scene.domain;
  const auto cells = [&](int axis) {
    return static_cast<int>(std::lround((domain.high[axis] - domain.low[axis]) / scene.water.spacing));
  };
  const int nx = cells(0), ny = domain.dimension == 2 ? cells(1) : 1;
  int wet = 0;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const double x = domain.low[0] + (i + 0.5) * (domain.high[0] - domain.low[0]) / nx;
      const double y = domain.low[1] + (j + 0.5) * (domain.high[1] - domain.low[1]) / ny;
      wet += scene.water.depth(x, y) > scene.water.wet_above ? 1 : 0;
    }
  }
  return wet;
}

}  // namespace

TEST_CASE("Case dam_break_wet") {
  const Scene scene = read_scene(cases + "dam_break_wet.toml");
  CHECK(scene.domain.dimension == 1);
  CHECK(scene.water.start == Water::Start::equal_mass);
  CHECK(scene.water.depth(999, 0) == 10);
  CHECK(scene.water.depth(1001, 0) == 5);
  CHECK(scene.walls.size() == 2);
  CHECK(scene.compare.samples == 9);
  CHECK(scene.compare.window == Approx(2 * 10 / 9.3538).epsilon(1e-5));  // S to four decimals
  CHECK(scene.end_time - 0.5 * scene.compare.window == Approx(50));
}

TEST_CASE("Case thacker") {
  const Scene scene = read_scene(cases + "thacker.toml");
  CHECK(wet_cells(scene) == 11304);  // the thesis' number of particles
  CHECK(scene.end_time == Approx(2 * pi * 3000 / std::sqrt(2 * 9.81 * 10)));
  CHECK(scene.sph.acceleration == Acceleration::classical);
  // The surface that the water starts from lies on the bed of the scene.
  CHECK(scene.bed.elevation(3000, 0) == Approx(0).margin(1e-12));
  CHECK(scene.compare.exact->at(1500, 0, 0).depth == Approx(10));
}

TEST_CASE("Case thacker_radial") {
  const Scene scene = read_scene(cases + "thacker_radial.toml");
  CHECK(scene.end_time == Approx(2 * pi * 3000 / std::sqrt(8 * 9.81 * 10)));
  CHECK(scene.water.depth(0, 0) == Approx(10 * std::sqrt(0.75) / 0.5));
}

TEST_CASE("Cases dam_break_radial and dam_break_radial_dry") {
  const Scene wet = read_scene(cases + "dam_break_radial.toml"),
              dry = read_scene(cases + "dam_break_radial_dry.toml");
  CHECK(wet_cells(dry) == 5024);  // the thesis: 5000
  CHECK(wet.water.depth(70, 70) == 10);
  CHECK(wet.water.depth(71, 71) == 5);
  CHECK(wet.compare.exact->at(600, 0, 50).depth ==
        Approx(5).epsilon(1e-9));  // the walls have not been reached
  CHECK(wet.compare.where(639, 0) != 0);
  CHECK(wet.compare.where(460, 460) == 0);
  CHECK(wet.compare.times == dry.compare.times);
}

TEST_CASE("Case lake_at_rest") {
  const Scene scene = read_scene(cases + "lake_at_rest.toml");
  CHECK(wet_cells(scene) == 25);
  CHECK(scene.water.depth(0.5, 0) == Approx(0.4));
  CHECK(scene.compare.exact->at(0.5, 0, 3).depth == Approx(0.4));
}

TEST_CASE("Case okushiri") {
  std::optional<Scene> found;
  try {
    found = read_scene(cases + "okushiri.toml");
  } catch (const DataError& error) {
    REQUIRE_THAT(error.what(), Catch::Contains("cannot find the file") || Catch::Contains("unpack it first"));
    std::cout << "SKIPPED: the Okushiri data are not there (tools/data okushiri)\n";
    return;
  }
  const Scene& scene = *found;
  CHECK(wet_cells(scene) == Approx(47900).epsilon(0.005));  // the thesis has 47,673
  // Levels at nodes: the file's first row is y = 3.402 m and begins with -0.13535 m.
  CHECK(scene.bed.elevation(0, 3.402) == Approx(-0.13535));
  CHECK(scene.bed.range[0] == Approx(-0.13535));
  CHECK(scene.bed.range[1] == Approx(0.125));
  CHECK(scene.bed.nodata == 0);
  CHECK(scene.boundaries.at(0).imposed.at(0).series.t.back() >= 22.5);
  REQUIRE(scene.walls.size() == 1);
  CHECK(scene.walls[0].line.size() == 4);
  REQUIRE(scene.gauges.size() == 3);
  const auto peak = [&](int k) {
    const Series& measured = *scene.gauges[k].measured;
    double highest = 0;
    for (std::size_t i = 0; i < measured.t.size() && measured.t[i] <= 22.5; ++i) {
      if (measured.t[i] >= 10) highest = std::max(highest, measured.value[i]);
    }
    return highest;
  };
  // Metres, from a file in cm; given to 0.01 cm.
  CHECK(peak(0) == Approx(0.0369).margin(5e-5));
  CHECK(peak(1) == Approx(0.0390).margin(5e-5));
  CHECK(peak(2) == Approx(0.0454).margin(5e-5));
  CHECK(scene.run_ups.size() == 3);
}

TEST_CASE("Every case describes itself and its text reads back to itself") {
  for (const auto& entry : std::filesystem::directory_iterator(cases)) {
    if (entry.path().extension() != ".toml") continue;
    INFO(entry.path().string());
    try {
      const Scene scene = read_scene(entry.path().string());
      CHECK(describe(scene).size() >= 7);
      // Data files are absolute in the text: it can be read from anywhere.
      CHECK(read_scene_text(scene.text, "/nowhere/scene.toml").text == scene.text);
    } catch (const DataError&) {
      continue;  // data of this case are not there; its own test says so
    }
  }
}
