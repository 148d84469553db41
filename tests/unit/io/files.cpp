// Directories and files that cannot be used, and the room that an output needs.
#include <catch2/catch.hpp>

#include <filesystem>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

TEST_CASE("results need a directory") {
  const test::Scratch scratch;
  write_text(scratch / "file", "here");
  CHECK_THROWS_AS(make_directory(scratch / "file"), IoError);
  CHECK_THROWS_WITH(make_directory(scratch / "file/below"), Catch::Contains(scratch / "file/below"));
  CHECK_NOTHROW(make_directory(scratch / "a/b/c"));
  CHECK(std::filesystem::is_directory(scratch / "a/b/c"));
}

TEST_CASE("an output that does not fit is refused before it begins") {
  const test::Scratch scratch;
  CHECK_NOTHROW(require_space(scratch.path(), 1));
  // 2^60 bytes: more than any file system here has.
  CHECK_THROWS_WITH(
      require_space(scratch.path(), std::uint64_t(1) << 60),
      Catch::Contains(scratch.path()) && Catch::Contains("No space left") && Catch::Contains("--out"));
}

TEST_CASE("text files are replaced as a whole") {
  const test::Scratch scratch;
  write_text(scratch / "a", "old and longer");
  write_text(scratch / "a", "new\n");
  CHECK(read_text(scratch / "a") == "new\n");
  CHECK_FALSE(std::filesystem::exists(scratch / "a.new"));
  CHECK_THROWS_AS(write_text(scratch / "missing/a", "x"), IoError);
  CHECK_THROWS_AS(read_text(scratch / "missing"), IoError);
}
