// The real command line on the fake method: its exit code and what it prints.
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/run/commands/cli.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/watch/scratch.hpp"

namespace freshet::test {

// The fake method behind the real command line; `prepare` sees each method before it runs.
inline Parts fake_parts(std::function<void(FakeMethod&)> prepare = {}) {
  Parts parts;
  parts.read = [](const std::string& path, const std::vector<std::string>& overrides) {
    if (!overrides.empty()) throw SceneError(path + ":1:1: error: unknown key '" + overrides[0] + "'");
    Scene scene = fake_scene();
    scene.file = path;
    return scene;
  };
  parts.read_again = [](const std::string&, const std::string&) { return fake_scene(); };
  parts.make = [prepare](const Scene& scene) {
    auto method = std::make_unique<FakeMethod>(scene);
    if (prepare) prepare(*method);
    return method;
  };
  parts.describe = [](const Scene& scene) { return std::vector<std::string>{"scene       " + scene.name}; };
  return parts;
}

struct CommandResult {
  int code;
  std::string out, err;
};

// Sends a standard stream to a file for the length of a scope.
class Redirect {
 public:
  Redirect(std::FILE* stream, const std::string& path) : stream_(stream), saved_(::dup(::fileno(stream))) {
    std::fflush(stream_);
    const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    ::dup2(file, ::fileno(stream_));
    ::close(file);
  }
  ~Redirect() {
    std::fflush(stream_);
    ::dup2(saved_, ::fileno(stream_));
    ::close(saved_);
  }

 private:
  std::FILE* stream_;
  int saved_;
};

inline CommandResult freshet_with(const Parts& parts, std::vector<std::string> words) {
  const Scratch scratch;
  words.insert(words.begin(), "freshet");
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  CommandResult result{};
  {
    const Redirect out(stdout, scratch / "out"), err(stderr, scratch / "err");
    result.code = run_cli(static_cast<int>(argv.size()), argv.data(), parts);
  }
  result.out = read_text(scratch / "out");
  result.err = read_text(scratch / "err");
  return result;
}

inline CommandResult freshet_with(std::vector<std::string> words) {
  return freshet_with(fake_parts(), std::move(words));
}

// A scene file for the fake reader, which does not look into it.
inline std::string scene_in(const Scratch& scratch) {
  write_text(scratch / "scene.toml", "");
  return scratch / "scene.toml";
}

}  // namespace freshet::test
