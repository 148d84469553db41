#include "src/run/timing/launch_times.hpp"

#include <Kokkos_Core.hpp>

#include <stdexcept>

namespace freshet {
namespace tools = Kokkos::Tools::Experimental;
namespace {

double seconds_since(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

void add(LaunchTimes::Span& span, double seconds) {
  ++span.calls;
  span.seconds += seconds;
}

double seconds_of(const LaunchTimes::Spans& spans, const std::string& name) {
  const auto found = spans.find(name);
  return found == spans.end() ? 0 : found->second.seconds;
}

}  // namespace

LaunchTimes* LaunchTimes::current_ = nullptr;

LaunchTimes::LaunchTimes() {
  if (current_) throw std::logic_error("launches are being timed already");
  current_ = this;
  listen(true);
}

LaunchTimes::~LaunchTimes() {
  listen(false);
  current_ = nullptr;
}

void LaunchTimes::listen(bool on) {
  tools::set_begin_parallel_for_callback(on ? begin_launch : nullptr);
  tools::set_begin_parallel_reduce_callback(on ? begin_launch : nullptr);
  tools::set_begin_parallel_scan_callback(on ? begin_launch : nullptr);
  tools::set_end_parallel_for_callback(on ? end_launch : nullptr);
  tools::set_end_parallel_reduce_callback(on ? end_launch : nullptr);
  tools::set_end_parallel_scan_callback(on ? end_launch : nullptr);
  tools::set_push_region_callback(on ? push : nullptr);
  tools::set_pop_region_callback(on ? pop : nullptr);
}

void LaunchTimes::begin_launch(const char* label, std::uint32_t, std::uint64_t*) {
  if (current_->depth_++ == 0) current_->launch_ = {label, Time::now()};
}

void LaunchTimes::end_launch(std::uint64_t) {
  if (current_->depth_ == 0 || --current_->depth_ > 0) return;
  const double seconds = seconds_since(current_->launch_.begun);
  add(current_->launches_[current_->launch_.name], seconds);
  for (const Open& region : current_->open_) add(current_->inside_[region.name], seconds);
}

void LaunchTimes::push(const char* label) { current_->open_.push_back({label, Time::now()}); }

void LaunchTimes::pop() {
  if (current_->open_.empty()) return;
  add(current_->regions_[current_->open_.back().name], seconds_since(current_->open_.back().begun));
  current_->open_.pop_back();
}

void LaunchTimes::clear() {
  launches_.clear();
  regions_.clear();
  inside_.clear();
}

double LaunchTimes::launched() const {
  double sum = 0;
  for (const auto& launch : launches_) sum += launch.second.seconds;
  return sum;
}

double LaunchTimes::launched_in(const std::string& region) const { return seconds_of(inside_, region); }
double LaunchTimes::in(const std::string& region) const { return seconds_of(regions_, region); }

}  // namespace freshet
