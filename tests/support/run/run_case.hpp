// Runs one of the scenes in cases/ to its end, as the program does, and returns its summary and its water.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "build_info.hpp"
#include "src/io/fluid.hpp"
#include "src/methods/method.hpp"
#include "src/run/driver.hpp"
#include "src/run/record/errors.hpp"
#include "src/run/record/gauges.hpp"
#include "src/run/record/run_ups.hpp"
#include "src/run/record/transects.hpp"
#include "src/run/watch/energy.hpp"
#include "src/run/watch/monitor.hpp"
#include "src/run/watch/steadiness.hpp"
#include "src/scene/read.hpp"
#include "tests/support/watch/scratch.hpp"

namespace freshet::test {

Scene read_case(const std::string& name, const std::vector<std::string>& overrides = {});

// A run's summary and what stands in it, as numbers.
struct Results : Summary {
  MassBalance mass;
  Mechanics start, end;
  std::vector<GaugeResult> gauges;
  std::vector<RunUpResult> run_ups;
  std::vector<TransectResult> transects;
  ErrorNorms errors;  // at the end; unknown without an exact solution
  std::vector<ErrorsAt> errors_at;
  Steadiness steady;
};

Results results_of(const Driver& driver, const Method& method);

double mean_rmse(const Results& results);  // m, over the gauges

struct CaseRun {
  Results summary;
  std::vector<Series> gauges;            // m, elevations in the order of the scene
  Fluid fluid;                           // at the end
  std::shared_ptr<const Method> method;  // likewise

  template <class Where>
  double mass_where(const Where& where) const {  // m3
    double sum = 0;
    for (std::size_t i = 0; i < fluid.size(); ++i)
      if (where(fluid.x[i], fluid.y[i])) sum += fluid.mass[i];
    return sum;
  }
};

CaseRun finish_case(const std::string& name, const std::vector<std::string>& overrides = {});

Results run_case(const std::string& name, const std::vector<std::string>& overrides = {});

// Whether the Okushiri benchmark's files are where a scene would find them.
bool has_okushiri_data();

}  // namespace freshet::test
