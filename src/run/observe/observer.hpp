// What looks at a run from step to step. src/run/observers.cpp lists the kinds and makes those that the scene
// asks for; what it does not ask for is not there. The loop knows one by name, the monitor: of the mass and
// the time step.
//
// A class has a constructor Class(const Scene&) or, where it writes, Class(const Scene&, const std::string&
// directory), and its own of the two static functions below where they differ.
#pragma once
#include <string>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/methods/method.hpp"
#include "src/run/observe/events.hpp"
#include "src/run/observe/report.hpp"

namespace freshet {

class Observer {
 public:
  static bool wanted(const Scene&) { return true; }       // whether the scene asks for it
  static std::vector<std::string> files() { return {}; }  // and folders that it may write

  Timetable times;  // steps end on these, and take() is called; the loop ticks them off

  explicit Observer(std::vector<double> take_times = {}) : times(std::move(take_times)) {}
  virtual ~Observer() = default;

  virtual void begin(const Method&) {}  // a new run, at t = 0
  virtual void before_step(const Method&, const Clock&, const Stride&) {}
  virtual void after_step(const Method&, const Clock&) {}
  virtual void take(const Method&, const Clock&) {}      // behind after_step()
  virtual void finish(const Method&, const Clock&) {}    // behind the last step, also of an interrupted run
  virtual void diverged(const Method&, const Clock&) {}  // instead of finish()
  virtual double seconds_apart() const { return 0; }     // s of wall clock that are no part of the run

  // Whatever the values count must be on the disk. Names are shared by all observers.
  virtual void save(Values&) const {}
  virtual void restore(const Values&, const Clock&) {}

  virtual void report(const Method&, const Clock&, Report&) const {}
};

}  // namespace freshet
