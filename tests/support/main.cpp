// The tests' main. Catch's command line comes first, and Kokkos is started only to run tests: what it prints
// while it starts would be taken for test names when CTest asks for the list.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <cstdlib>

#include "cellgrid/parallel/runtime.hpp"

int main(int argc, char** argv) {
  Catch::Session session;
  if (const int failed = session.applyCommandLine(argc, argv)) return failed;
  const Catch::ConfigData& asked = session.configData();
  const bool only_talks = asked.showHelp || asked.libIdentify || asked.listTests || asked.listTags ||
                          asked.listReporters || asked.listTestNamesOnly;
  if (only_talks) return session.run();
  const char* threads = std::getenv("FRESHET_TEST_THREADS");  // tests/support/watch/threads.hpp
  const freshet::Runtime kokkos(threads ? std::atoi(threads) : 0);
  return session.run();
}
