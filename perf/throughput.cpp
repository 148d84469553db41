// perf_throughput [--threads N] [--largest N] [Google Benchmark's options]: every pass alone, for several
// numbers of particles and arrangements. Columns: ns per particle (process time is not used: the passes are
// timed by the wall clock), millions of particles and of pairs within the support per second, modelled
// GFLOP/s and GB/s, and their shares of the peaks measured before.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>

#include "cellgrid/parallel/runtime.hpp"
#include "perf/passes.hpp"
#include "src/run/timing/peaks.hpp"

namespace {

using namespace freshet;
using namespace freshet::perf;
using Clock = std::chrono::steady_clock;

Peaks peaks;

void put_counters(benchmark::State& state, const Work& work, double seconds) {
  const double flops = work.flops / seconds, bytes = work.bytes / seconds;
  state.counters["ns"] = 1e9 * seconds / work.particles;
  state.counters["Mpart/s"] = 1e-6 * work.particles / seconds;
  state.counters["Mpairs/s"] = 1e-6 * work.pairs / seconds;
  state.counters["GFLOP/s"] = 1e-9 * flops;
  state.counters["GB/s"] = 1e-9 * bytes;
  state.counters["ofFMA"] = flops / peaks.flops;
  state.counters["ofTriad"] = bytes / peaks.bytes;
  state.counters["peakGFLOP/s"] = 1e-9 * peaks.flops;
  state.counters["triadGB/s"] = 1e-9 * peaks.bytes;
}

// The fastest run counts: what other programs take from the machine only adds to the others.
void time_pass(benchmark::State& state, const Pass& pass) {
  pass.prepare();
  pass.run();
  double least = 1e300;
  for (auto _ : state) {
    pass.prepare();
    const auto begun = Clock::now();
    pass.run();
    Exec().fence();
    const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    state.SetIterationTime(seconds);
    least = std::min(least, seconds);
  }
  put_counters(state, pass.work(), least);
}

// Water is made when the first benchmark that needs it runs, and kept for the next alone: a million particles
// take 300 MB.
class Pool {
 public:
  std::shared_ptr<Water> get(Arrangement arrangement, int n, const std::string& extra) {
    const auto key = std::make_tuple(arrangement, n, extra);
    if (key == key_ && water_) return water_;
    water_.reset();
    key_ = key;
    water_ = std::make_shared<Water>(arrangement, n);
    if (extra == "bed") water_->add_bed();
    if (extra == "friction") water_->add_friction();
    if (extra == "matrix") water_->add_matrix();
    if (extra == "mirror") water_->add_walls(WallKind::images);
    if (extra == "rows") water_->add_walls(WallKind::image_rows);
    if (extra == "mvbp") water_->add_walls(WallKind::mvbp);
    return water_;
  }

 private:
  std::tuple<Arrangement, int, std::string> key_;
  std::shared_ptr<Water> water_;
};

std::vector<Pass> passes_of(const std::shared_ptr<Water>& water, const std::string& extra) {
  const PassList all(water);
  if (extra.empty()) return all.plain();
  if (extra == "bed") return all.with_bed();
  if (extra == "friction") return all.with_friction();
  if (extra == "matrix") return all.with_matrix();
  return all.with_walls(extra);
}

void add_benchmarks(Pool& pool, Arrangement arrangement, int n, const std::string& extra) {
  const auto names = [&] {  // of the passes; a handful of particles will do
    std::vector<std::string> all;
    auto few = std::make_shared<Water>(Arrangement::uniform, 100);
    for (const Pass& pass : passes_of(few, extra)) all.push_back(pass.name);
    return all;
  }();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string name = names[k] + "/" + name_of(arrangement) + "/" + std::to_string(n);
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&pool, arrangement, n, extra, k](benchmark::State& state) {
                                   time_pass(state, passes_of(pool.get(arrangement, n, extra), extra)[k]);
                                 })
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  }
}

// Takes our own option with its number out of the command line.
int take_option(int& argc, char** argv, const char* option, int otherwise) {
  for (int k = 1; k + 1 < argc; ++k) {
    if (std::strcmp(argv[k], option) != 0) continue;
    const int value = std::atoi(argv[k + 1]);
    for (int m = k; m + 2 < argc; ++m) argv[m] = argv[m + 2];
    argc -= 2;
    return value;
  }
  return otherwise;
}

}  // namespace

int main(int argc, char** argv) {
  const int threads = take_option(argc, argv, "--threads", 1),
            largest = take_option(argc, argv, "--largest", 1000000);
  const Runtime runtime(threads);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  peaks = measure_peaks();
  benchmark::AddCustomContext("threads", std::to_string(thread_count()));
  benchmark::AddCustomContext("peak_flops_per_s", std::to_string(peaks.flops));
  benchmark::AddCustomContext("triad_bytes_per_s", std::to_string(peaks.bytes));
  Pool pool;
  for (int n = 1000; n <= largest; n *= 10) {
    for (const Arrangement a : {Arrangement::uniform, Arrangement::graded, Arrangement::clustered})
      add_benchmarks(pool, a, n, "");
    for (const char* extra : {"bed", "friction", "matrix", "mirror", "rows", "mvbp"})
      add_benchmarks(pool, Arrangement::uniform, n, extra);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
