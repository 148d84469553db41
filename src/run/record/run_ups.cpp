#include "src/run/record/run_ups.hpp"

#include "cellgrid/parallel/on_device.hpp"

namespace freshet {

RunUpRecorder::RunUpRecorder(const Scene& scene) : points_(scene.run_ups) {
  std::vector<ShorePlace> shores;
  for (const RunUp& point : points_)
    shores.push_back({point.at[0], point.at[1], point.radius, point.min_depth});
  shores_.shore = on_device("run_up.shores", shores);
  shores_.highest = on_device("run_up.highest", std::vector<WetLevels>(shores.size()));
}

std::vector<WetLevels> RunUpRecorder::highest() const {
  const auto host = on_host(shores_.highest);
  return {host.data(), host.data() + host.extent(0)};
}

void RunUpRecorder::save(Values& values) const {
  std::vector<double>& all = values["run_up"];
  for (const WetLevels& w : highest()) all.insert(all.end(), {w.bed, w.line});
}

void RunUpRecorder::restore(const Values& values, const Clock&) {
  const std::vector<double>& all = values.at("run_up");
  std::vector<WetLevels> highest;
  for (std::size_t k = 0; k < points_.size(); ++k) highest.push_back({all.at(2 * k), all.at(2 * k + 1)});
  shores_.highest = on_device("run_up.highest", highest);
}

std::vector<RunUpResult> RunUpRecorder::results() const {
  const auto levels = highest();
  std::vector<RunUpResult> results;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    RunUpResult& result = results.emplace_back(RunUpResult{points_[k].name});
    if (levels[k].bed > -1e299) result.highest = levels[k].bed, result.waterline = levels[k].line;
    if (const auto& range = points_[k].measured) result.measured = {(*range)[0], (*range)[1]};
  }
  return results;
}

void RunUpRecorder::report(const Method&, const Clock&, Report& report) const {
  JsonWriter& highest = report.object("runup");
  JsonWriter& waterline = report.object("waterline");
  report.tables +=
      formatted("\n%-12s %12s %13s   %s\n", "run-up", "highest [m]", "waterline [m]", "measured [m]");
  for (const RunUpResult& r : results()) {
    highest.value(r.name, r.highest);
    waterline.value(r.name, r.waterline);
    const auto m = [](double value) { return decimal(value, 1, 4); };
    const bool known = std::isfinite(r.measured.first);
    report.tables +=
        formatted("%-12s %12s %13s   %s\n", r.name.c_str(), m(r.highest).c_str(), m(r.waterline).c_str(),
                  known ? (m(r.measured.first) + " ... " + m(r.measured.second)).c_str() : "-");
  }
  highest.end();
  waterline.end();
}

}  // namespace freshet
