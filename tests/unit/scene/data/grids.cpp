// Grids and points in files: every tolerance of their formats, and the errors that name file and line.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::Directory;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_in;

namespace {

Scene with_bed(const Directory& here, const std::string& keys) {
  return read_in(here, pond("[bed]\n" + keys));
}

std::string bed_error(const std::string& name, const std::string& data, const std::string& keys = "") {
  const Directory here;
  here.write(name, data);
  const test::Failure found =
      failure(pond("[bed]\nfile = \"" + name + "\"\n" + keys), {}, here.path() + "/scene.toml");
  return found.text.substr(std::min(found.text.size(), here.path().size() + 1));
}

// z = x + 10 y on the corners of 5 m cells over the pond and a little more; the first row is the highest y.
const char* const grid =
    "ncols 4\nnrows 3\nxllcorner 0.0\nyllcorner 0.0\ncellsize 5\nNODATA_value -9999\n"
    "100 105 110 115\n50 55 60 65\n0 5 10 15\n";

}  // namespace

TEST_CASE("Node and cell registration differ by half a cell") {
  const Directory here;
  here.write("bed.asc", grid);
  const Function node = with_bed(here, "file = \"bed.asc\"\nregistration = \"node\"\n").bed.elevation;
  const Function cell = with_bed(here, "file = \"bed.asc\"\nregistration = \"cell\"\n").bed.elevation;
  // Bilinear interpolation gives a plane back to rounding.
  CHECK(node(3, 2) == Approx(23));
  CHECK(cell(3, 2) == Approx(3 - 2.5 + 10 * (2 - 2.5)));
}

TEST_CASE("xllcenter headers need no registration: they name the first value's place") {
  const Directory here;
  here.write("bed.asc",
             "NCOLS 4\nNROWS 3\nXLLCENTER 0.0\nYLLCENTER 0.0\nCELLSIZE 5\n"
             "100 105 110 115\n50 55 60 65\n0 5 10 15\n");
  CHECK(with_bed(here, "file = \"bed.asc\"\n").bed.elevation(3, 2) == Approx(23));
}

TEST_CASE("xllcorner headers need a registration") {
  CHECK(bed_error("bed.asc", grid) ==
        "scene.toml:9:8: error: 'bed.asc' has an xllcorner header: say where its values lie, "
        "'bed.registration' is missing\n"
        "  file = \"bed.asc\"\n"
        "         ^\n"
        "  help: registration = \"cell\": in the middle of the cells (GIS rasters); \"node\": on the corner "
        "itself");
}

TEST_CASE("Grids go on linearly for a few cells, then constantly") {
  const Directory here;
  here.write("bed.asc", grid);
  const Function z = with_bed(here, "file = \"bed.asc\"\nregistration = \"node\"\n").bed.elevation;
  CHECK(z(-7, 0) == Approx(-7));
  CHECK(z(-40, 0) == Approx(-40));  // eight cells
  CHECK(z(-1000, 0) == Approx(-40));
}

TEST_CASE("Depths, units and data become levels: sign, scale, then offset") {
  const Directory here;
  here.write("bed.asc", grid);
  const Scene scene = with_bed(here,
                               "file = \"bed.asc\"\nregistration = \"node\"\nvertical = \"down\"\n"
                               "scale = 0.1\noffset = 2\n");
  CHECK(scene.bed.elevation(3, 2) == Approx(-2.3 + 2));
  CHECK(scene.bed.range[0] == Approx(-0.1 * 60 + 2));
  CHECK(scene.bed.spacing == 5);
  CHECK(scene.bed.description == "file bed.asc (4 x 3 nodes)");
}

TEST_CASE("A missing value of a grid is an error, or the level that the scene chooses") {
  std::string holed = grid;
  holed.replace(holed.find("55"), 2, "-9999");
  const std::string error = bed_error("bed.asc", holed, "registration = \"node\"\n");
  CHECK_THAT(error, Catch::Contains("'bed.asc' has no value at 1 node near the domain, the first at (5, 5)"));
  CHECK_THAT(error, Catch::Contains("nodata = { fill = 0.0 }"));
  const Directory here;
  here.write("bed.asc", holed);
  // The fill is a level: neither sign nor offset of the file act on it.
  const Scene scene =
      with_bed(here, "file = \"bed.asc\"\nregistration = \"node\"\noffset = 1\nnodata = { fill = 7.0 }\n");
  CHECK(scene.bed.elevation(5, 5) == Approx(7));
  CHECK(scene.bed.elevation(0, 0) == Approx(1));
  CHECK(scene.bed.nodata == 1);
}

TEST_CASE("A grid whose header and values disagree is an error with the line at fault") {
  std::string short_row = grid;
  short_row.replace(short_row.find(" 65"), 3, "");
  CHECK_THAT(
      bed_error("bed.asc", short_row, "registration = \"node\"\n"),
      Catch::StartsWith("scene.toml:9:8: error: bed.asc:8: the header promises 4 x 3 = 12 values, the file "
                        "holds 11; this line holds 3\n"));
  CHECK_THAT(bed_error("bed.asc", std::string(grid) + "1 2 3 4\n", "registration = \"node\"\n"),
             Catch::Contains("bed.asc:10: the header promises 4 x 3 = 12 values, the file holds 16"));
  CHECK_THAT(bed_error("bed.asc", "ncols 4\nnrows 3\ncellsize 5\n1 2 3 4\n", "registration = \"node\"\n"),
             Catch::Contains("bed.asc:3: the header has no 'xllcorner'"));
  CHECK_THAT(bed_error("bed.asc", "ncols four\n", "registration = \"node\"\n"),
             Catch::Contains("bed.asc:1: 'ncols' must be followed by one number"));
  std::string word = grid;
  word.replace(word.find("60"), 2, "n/a");
  CHECK_THAT(bed_error("bed.asc", word, "registration = \"node\"\n"),
             Catch::Contains("bed.asc:8: 'n/a' is not a number"));
}

TEST_CASE("A domain that reaches beyond the file is an error") {
  std::string small = grid;
  small.replace(small.find("cellsize 5"), 10, "cellsize 2");
  CHECK_THAT(bed_error("bed.asc", small, "registration = \"node\"\n"),
             Catch::Contains("'bed.asc' covers x = 0 to 6 m, the domain 0 to 10 m"));
}

TEST_CASE("Formats that are not read say how to convert") {
  CHECK_THAT(bed_error("dem.tif", "II*"),
             Catch::Contains("'dem.tif' is a GeoTIFF") &&
                 Catch::Contains("help: convert it: gdal_translate -of AAIGrid dem.tif dem.asc"));
  CHECK_THAT(bed_error("dem.nc", "CDF"), Catch::Contains("gdal_translate -of AAIGrid dem.nc dem.asc"));
  CHECK_THAT(bed_error("bed.xyz.bz2", "BZh"),
             Catch::Contains("'bed.xyz.bz2' is compressed") && Catch::Contains("help: unpack it first"));
}

TEST_CASE("A file that is there only in packed form says so") {
  const Directory here;
  here.write("bed.asc.gz", "x");
  const test::Failure found = failure(pond("[bed]\nfile = \"bed.asc\"\n"), {}, here.path() + "/scene.toml");
  CHECK_THAT(found.text, Catch::Contains("help: there is " + here.path() + "/bed.asc.gz: unpack it first"));
}

TEST_CASE("Points on a lattice are found in any order of rows") {
  std::string fast_x, fast_y, shuffled;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 4; ++i) {
      const auto row = [](int a, int b) {
        return std::to_string(5 * a) + ' ' + std::to_string(5 * b) + ' ' + std::to_string(5 * a + 50 * b) +
               '\n';
      };
      fast_x += row(i, j);
      shuffled = (i + j) % 2 == 0 ? row(i, j) + shuffled : shuffled + row(i, j);
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      fast_y += std::to_string(5 * i) + ',' + std::to_string(5 * j) + ',' + std::to_string(5 * i + 50 * j) +
                ",\r\n";
    }
  }
  for (const std::string& data : {fast_x, "x,y,z\r\n" + fast_y, shuffled}) {
    const Directory here;
    here.write("bed.xyz", data);
    const Scene scene = with_bed(here, "file = \"bed.xyz\"\n");
    CHECK(scene.bed.elevation(3, 2) == Approx(23));
    CHECK(scene.bed.description == "file bed.xyz (4 x 3 nodes from x-y-z points)");
  }
}

TEST_CASE("Rounded coordinates still make a lattice, missing points are missing values") {
  std::string data;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 7; ++i) {
      char row[64];
      std::snprintf(row, sizeof row, "%.2f %.2f %g\n", i * 10 / 6.0, j * 5 / 3.0, i + 10.0 * j);
      if (i != 2 || j != 1) data += row;
    }
  }
  CHECK_THAT(bed_error("bed.xyz", data),
             Catch::Contains("has no value at 1 node near the domain, the first at (3.33"));
}

TEST_CASE("Scattered points are interpolated between the nearest") {
  std::string data;
  for (int k = 0; k < 400; ++k) {  // Weyl sequence: no two on a lattice
    const double x = -1 + 12 * std::fmod(k * 0.7548776662466927, 1.0);
    const double y = -1 + 7 * std::fmod(k * 0.5698402909980532, 1.0);
    data += std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(0.1 * x) + '\n';
  }
  const Directory here;
  here.write("bed.xyz", data);
  const Scene scene = with_bed(here, "file = \"bed.xyz\"\n");
  CHECK(scene.bed.description == "file bed.xyz (400 scattered points, inverse distance of the 8 nearest)");
  // Neighbours lie within about a mean distance (0.46 m) and the slope is 0.1: twice their product is ample.
  for (const double x : {1.0, 5.0, 9.0}) CHECK(scene.bed.elevation(x, 2.5) == Approx(0.1 * x).margin(0.09));
}

TEST_CASE("A row of points that is not x y z is an error with its line") {
  CHECK_THAT(bed_error("bed.xyz", "x y z\n0 0 1\n1 0\n"),
             Catch::Contains("bed.xyz:3: three numbers are wanted, x y z"));
}

TEST_CASE("A bed from a file is smoothed at the scale of h, others are not") {
  const Directory here;
  here.write("bed.asc", grid);
  const double h = 1.2 * 0.5;
  // Second moment per axis of the cubic spline in 2-D: 31/98 h2, rounded to 0.31633 in the literature.
  CHECK(with_bed(here, "file = \"bed.asc\"\nregistration = \"node\"\n").bed.filter ==
        Approx(std::sqrt(0.31633) * h).epsilon(1e-5));
  CHECK(with_bed(here, "file = \"bed.asc\"\nregistration = \"node\"\nfilter = \"none\"\n").bed.filter == 0);
  CHECK(with_bed(here, "z = \"0.1*x\"\n").bed.filter == 0);
  CHECK(with_bed(here, "z = \"0.1*x\"\nfilter = 0.7\n").bed.filter == 0.7);
  const Scene line = test::read_text(
      "[domain]\nbox = [0, 1]\n[water]\nsurface = 1\nspacing = 0.1\n[time]\nend = 1\n"
      "[bed]\nz = \"0.1*x\"\nfilter = \"h\"\n");
  CHECK(line.bed.filter == Approx(0.1 / std::sqrt(3.0)));  // h2/3 in 1-D, and h = dx there
}
