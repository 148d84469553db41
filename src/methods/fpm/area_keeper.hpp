// Keeps the water's area where geometry changes it (docs/formulas/fpm.md (F31)): gaps that close hold no air
// (the equations know none), films and threads of one row count for nothing. What is more than `band` off the
// start's is given back evenly over `steps` steps as a divergence of the velocity, and said in the summary.
// Below the band nothing is touched. Reads areas [m2] and time steps [s].
#pragma once
#include <string>
#include <vector>

namespace freshet::fpm {

class AreaKeeper {
 public:
  // of the area at the start; dam breaks, drops and waves stay below 0.0015
  static constexpr double band = 0.005;
  static constexpr double steps = 25;  // in which it goes back; a point moves by half a spacing in one
  static constexpr int every = 10;     // steps from look to look

  void start(double area) { start_ = area; }
  bool is_due() const { return count_ % every == 0; }
  void look(double area, double dt);
  void pass(double dt);  // a step was made

  double expansion() const { return rate_; }  // 1/s, the divergence
  std::vector<std::string> notes() const;

  std::vector<double> state() const {
    return {start_, rate_, static_cast<double>(count_), shrunk_, grown_, first_, t_};
  }
  void restore(const std::vector<double>& state);

 private:
  double start_ = 0, rate_ = 0;    // m2; 1/s
  long count_ = 0;                 // steps
  double shrunk_ = 0, grown_ = 0;  // of the start's area, given back so far
  double first_ = -1, t_ = 0;      // s
};

}  // namespace freshet::fpm
