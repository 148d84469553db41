// gauges.csv and measured.csv: titles, round trip to the bit, continuation after a cut.
#include <catch2/catch.hpp>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/io/gauges.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

namespace {

std::vector<Gauge> two_gauges() {
  Gauge a, b;
  a.name = "ch5";
  b.name = "left, far";
  return {a, b};
}

GaugeRow row(double t) { return {t, {1 / 3.0 + t, -0.1 * t}, {false, true}}; }

}  // namespace

TEST_CASE("gauge rows come back to the bit and are continued after a cut") {
  const test::Scratch scratch;
  const std::string path = scratch / "gauges.csv";
  {
    GaugeFile file(path);
    file.create(two_gauges());
    for (int k = 0; k < 5; ++k) file.append(row(0.05 * k));
  }
  GaugeFile file(path);
  const auto rows = file.continue_after(3);
  REQUIRE(rows.size() == 3);
  CHECK(rows[2].t == row(0.05 * 2).t);
  CHECK(rows[2].value == row(0.05 * 2).value);
  CHECK(rows[2].dry == row(0.05 * 2).dry);
  file.append(row(7));
  CHECK(read_text(path) ==
        "t [s],ch5 elevation [m],ch5 dry,\"left, far elevation [m]\",\"left, far dry\"\n"
        "0,0.3333333333333333,0,-0,1\n"
        "0.05,0.3833333333333333,0,-0.005000000000000001,1\n"
        "0.1,0.43333333333333335,0,-0.010000000000000002,1\n"
        "7,7.333333333333333,0,-0.7000000000000001,1\n");
}

TEST_CASE("titles and measurements carry what each gauge shows, in its unit") {
  const test::Scratch scratch;
  std::vector<Gauge> gauges = two_gauges();
  gauges[0].what = Gauge::What::pressure, gauges[0].measured = Series{{0}, {5000}};
  gauges[1].what = Gauge::What::front;
  GaugeFile(scratch / "gauges.csv").create(gauges);
  write_measured(scratch / "measured.csv", gauges);
  CHECK(read_text(scratch / "gauges.csv") ==
        "t [s],ch5 pressure [Pa],ch5 dry,\"left, far front [m]\",\"left, far dry\"\n");
  CHECK(read_text(scratch / "measured.csv") == "t [s],ch5 [Pa]\n0,5000\n");
}

TEST_CASE("a gauge file with fewer rows than the checkpoint counts is an error") {
  const test::Scratch scratch;
  {
    GaugeFile file(scratch / "gauges.csv");
    file.create(two_gauges());
    file.append(row(0));
  }
  // A row that was cut short by a crash does not count.
  write_text(scratch / "gauges.csv", read_text(scratch / "gauges.csv") + "0.05,0.38");
  GaugeFile file(scratch / "gauges.csv");
  CHECK_THROWS_AS(file.continue_after(2), IoError);
}

TEST_CASE("gauge rows on a full device are an error") {
  GaugeFile file("/dev/full");
  CHECK_THROWS_WITH(file.create(two_gauges()),
                    Catch::Contains("/dev/full") && Catch::Contains("No space left"));
}

TEST_CASE("measured series stand over the union of their times") {
  const test::Scratch scratch;
  auto gauges = two_gauges();
  write_measured(scratch / "measured.csv", gauges);
  CHECK_THROWS_AS(read_text(scratch / "measured.csv"), IoError);  // none measured, no file
  gauges[0].measured = Series{{0, 1}, {0.5, 0.25}};
  gauges[1].measured = Series{{1, 2}, {-1, -2}};
  write_measured(scratch / "measured.csv", gauges);
  CHECK(read_text(scratch / "measured.csv") == "t [s],ch5 [m],\"left, far [m]\"\n0,0.5,\n1,0.25,-1\n2,,-2\n");
}
