// Series of numbers in files: every tolerance of their formats, and the errors that name file and line.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::Directory;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_in;

namespace {

// A series from t = 0 to 10 s that rises from 0.1 to 0.3 m, however it is written.
std::string boundary(const std::string& columns) {
  return pond("[[boundary]]\nside = \"left\"\ntype = \"elevation\"\nseries = { file = \"wave.txt\", " +
              columns + " }\n");
}

void check_wave(const std::string& data, const std::string& columns) {
  INFO(data);
  const Directory here;
  here.write("wave.txt", data);
  const Scene scene = read_in(here, boundary(columns));
  const Series& level = scene.boundaries.at(0).imposed.at(0).series;
  CHECK(level.t == std::vector<double>{0, 5, 10});
  REQUIRE(level.value.size() == 3);
  for (int i = 0; i < 3; ++i) CHECK(level.value[i] == Approx(0.1 * (i + 1)));  // rounding of scale and offset
  CHECK(level.at(2.5) == Approx(0.15));
}

std::string data_error(const std::string& data, const std::string& scene) {
  const Directory here;
  here.write("wave.txt", data);
  const test::Failure found = failure(scene, {}, here.path() + "/scene.toml");
  CHECK(found.exit == Exit::data);
  const std::string text = found.text;
  return text.substr(std::min(text.size(), here.path().size() + 1));  // without the directory
}

}  // namespace

TEST_CASE("Series are read whatever separates their columns") {
  check_wave("0 0.1\n5 0.2\n10 0.3\n", "t = 1, value = 2");
  check_wave("0\t0.1\n5\t0.2\n10\t0.3\n", "t = 1, value = 2");
  check_wave("0,0.1\n5,0.2\n10,0.3\n", "t = 1, value = 2");
  check_wave("0;0.1\n5;0.2\n10;0.3\n", "t = 1, value = 2");
  check_wave("   0.0   1e-1\n   5.0   +0.2\n  10.0   0.3", "t = 1, value = 2");
}

TEST_CASE("Series tolerate byte order mark, CRLF, trailing commas, comments and empty lines") {
  check_wave("\xEF\xBB\xBFt,eta\r\n0,0.1\r\n5,0.2\r\n10,0.3\r\n", "t = \"t\", value = \"eta\"");
  check_wave("t,eta,\n0,0.1,\n5,0.2,\n10,0.3,\n", "t = \"t\", value = \"eta\"");
  check_wave("# a wave\n\n0 0.1\n# half way\n5 0.2\n10 0.3\n\n", "t = 1, value = 2");
  check_wave("0,0.1\r5,0.2\r10,0.3\r", "t = 1, value = 2");
}

TEST_CASE("Columns go by number or by name, and names may hold blanks") {
  check_wave("x t eta\n9 0 0.1\n9 5 0.2\n9 10 0.3\n", "t = 2, value = 3");
  check_wave("time(s)     water surface(m)\n0\t0.1\n5\t0.2\n10\t0.3\n", "t = 1, value = 2");
  check_wave("time(s)     water surface(m)\n0\t0.1\n5\t0.2\n10\t0.3\n",
             "t = \"time(s)\", value = \"water surface(m)\"");
}

TEST_CASE("Scale and offset turn a column into metres") {
  check_wave("0 15\n5 25\n10 35\n", "t = 1, value = 2, scale = 0.01, offset = -0.05");
}

TEST_CASE("A series is constant before its first and after its last entry") {
  const Series series{{1, 2}, {5, 7}};
  CHECK(series.at(0) == 5);
  CHECK(series.at(3) == 7);
}

TEST_CASE("Forcing times that do not increase are an error that names both files") {
  CHECK(data_error("t eta\n0 1\n5 2\n5 3\n10 4\n", boundary("t = 1, value = 2")) ==
        "scene.toml:11:19: error: wave.txt:4: time 5 s follows 5 s; times must increase strictly\n"
        "  series = { file = \"wave.txt\", t = 1, value = 2 }\n"
        "                    ^\n"
        "  help: sort the rows and remove repeated times");
}

TEST_CASE("A forcing cell that is no number is an error that names its line and column") {
  CHECK_THAT(data_error("0 1\n5 high\n10 3\n", boundary("t = 1, value = 2")),
             Catch::Contains("wave.txt:2: column 2 holds 'high', not a number"));
  CHECK_THAT(data_error("0,1\n5,\n10,3\n", boundary("t = 1, value = 2")),
             Catch::Contains("wave.txt:2: column 2 is missing"));
  CHECK_THAT(data_error("0;0,5\n10;0,7\n", boundary("t = 1, value = 2")),
             Catch::Contains("'0,5', not a number\n"));
  CHECK_THAT(data_error("", boundary("t = 1, value = 2")), Catch::Contains("'wave.txt' holds no numbers"));
}

TEST_CASE("A column that the file does not have is an error of the scene, at the column's key") {
  const Directory here;
  here.write("wave.txt", "time,eta\n0,1\n10,1\n");
  const std::string file = here.path() + "/scene.toml";
  const test::Failure by_name = failure(boundary("t = \"time\", value = \"etta\""), {}, file);
  CHECK(by_name.exit == Exit::scene);
  CHECK(by_name.text == file +
                            ":11:51: error: 'wave.txt' has no column 'etta'\n"
                            "  series = { file = \"wave.txt\", t = \"time\", value = \"etta\" }\n"
                            "                                                    ^\n"
                            "  help: did you mean 'eta'?");
  CHECK_THAT(
      failure(boundary("t = 1, value = 3"), {}, file).text,
      Catch::Contains("'wave.txt' has no column 3") && Catch::Contains("it has 2 columns, counted from 1"));
}

TEST_CASE("Measured rows are sorted, repeated times and gaps left out, each with a note") {
  const Directory here;
  here.write("g.csv", "t,cm\n2,20\n0,10\n1,\n1,15\n2,99\n");
  const Scene scene =
      read_in(here, pond("[[gauge]]\nname = \"g\"\nat = [1, 1]\n"
                         "measured = { file = \"g.csv\", t = \"t\", value = \"cm\", scale = 0.01 }\n"));
  CHECK(scene.gauges[0].measured->t == std::vector<double>{0, 1, 2});
  CHECK(scene.gauges[0].measured->value[1] == Approx(0.15));
  CHECK(scene.gauges[0].measured->value[2] == Approx(0.20));  // the first of the repeated ones
  CHECK(scene.notes == std::vector<std::string>{"g.csv: 1 row without numbers left out", "g.csv: rows sorted",
                                                "g.csv: 1 row with a repeated time or place left out"});
}
