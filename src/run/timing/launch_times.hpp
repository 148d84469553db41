// Seconds and calls of every launch and region, by label, through Kokkos' tool callbacks: in this process,
// without a tool library. They are recorded while the object lives; one at a time in a process
// (std::logic_error otherwise).
#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace freshet {

class LaunchTimes {
 public:
  struct Span {
    long calls = 0;
    double seconds = 0;
  };
  using Spans = std::map<std::string, Span>;

  LaunchTimes();
  ~LaunchTimes();
  LaunchTimes(const LaunchTimes&) = delete;
  LaunchTimes& operator=(const LaunchTimes&) = delete;

  void clear();
  const Spans& launches() const { return launches_; }  // a launch inside another counts as part of that one
  const Spans& regions() const { return regions_; }    // with everything inside, other regions too

  double launched() const;                              // s, of all launches
  double launched_in(const std::string& region) const;  // s, of the launches inside a region
  double in(const std::string& region) const;           // s

 private:
  using Time = std::chrono::steady_clock;
  struct Open {
    std::string name;
    Time::time_point begun;
  };

  static void begin_launch(const char* label, std::uint32_t, std::uint64_t*);
  static void end_launch(std::uint64_t);
  static void push(const char* label);
  static void pop();
  static void listen(bool on);

  static LaunchTimes* current_;
  Spans launches_, regions_, inside_;  // inside_: of launches, by region
  std::vector<Open> open_;             // regions
  int depth_ = 0;                      // of launches
  Open launch_;
};

}  // namespace freshet
