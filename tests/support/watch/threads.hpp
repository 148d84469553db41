// Runs a hidden test of this program again with other numbers of threads: Kokkos' number is fixed once it has
// started. The hidden test (tag [.]) calls say(); the same words must come back whatever the number of
// threads.
#pragma once
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace freshet::test {

inline constexpr const char* mark = "bits: ";

// The bits of the values, in short.
inline void say(const double* values, int n) {
  std::uint64_t hash = 1469598103934665603u;
  for (int i = 0; i < n; ++i) {
    std::uint64_t bits;
    std::memcpy(&bits, values + i, sizeof bits);
    hash = (hash ^ bits) * 1099511628211u;
  }
  std::printf("%s%d %016llx\n", mark, n, static_cast<unsigned long long>(hash));
}

// What the hidden test of that name says with so many threads; empty if it does not pass.
inline std::string said(const std::string& hidden_test, int threads) {
  std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const char* emulator = std::getenv("FRESHET_TEST_EMULATOR");  // of a program that is not for this machine
  program = (emulator ? std::string(emulator) + " '" : "'") + program + "'";
  const std::string command =
      "FRESHET_TEST_THREADS=" + std::to_string(threads) + " " + program + " '" + hidden_test + "' 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  std::string said;
  std::array<char, 256> line{};
  while (pipe && std::fgets(line.data(), line.size(), pipe))
    if (std::strncmp(line.data(), mark, std::strlen(mark)) == 0) said += line.data();
  return pipe && pclose(pipe) == 0 ? said : "";
}

}  // namespace freshet::test
