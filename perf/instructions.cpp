// perf_instructions: every pass on a few particles, instruction by instruction (ptrace), and the operations
// counted in them beside the modelled ones. Needs no performance counters, which virtual machines seldom
// have. x86-64 Linux; takes a minute.
#include <cstdio>

#if defined(__linux__) && defined(__x86_64__)
#include <sys/ptrace.h>
#include <sys/uio.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <unordered_map>

#include "cellgrid/parallel/runtime.hpp"
#include "perf/decode.hpp"
#include "perf/passes.hpp"

namespace {

using namespace freshet;
using namespace freshet::perf;

constexpr int particles = 256;  // stepping takes some 10 us an instruction

struct Count {
  double instructions = 0, flops = 0;
};

// What the child says before it starts, through a pipe.
struct Model {
  char name[40];
  double particles, listed, flops;
};

int flops_at(pid_t child, unsigned long long address) {
  std::uint8_t code[16] = {};
  iovec here{code, sizeof code},
      there{reinterpret_cast<void*>(address), sizeof code};  // NOLINT: an address of the child
  return process_vm_readv(child, &here, 1, &there, 1, 0) > 0 ? flops_of(code) : 0;
}

// Steps the child until it stops itself again.
Count step_through(pid_t child) {
  Count count;
  std::unordered_map<unsigned long long, int> known;
  int status = 0;
  for (;;) {
    user_regs_struct registers;
    ptrace(PTRACE_GETREGS, child, nullptr, &registers);
    const auto [entry, unseen] = known.try_emplace(registers.rip, 0);
    if (unseen) entry->second = flops_at(child, registers.rip);
    count.flops += entry->second;
    ++count.instructions;
    ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
    if (waitpid(child, &status, 0) < 0 || !WIFSTOPPED(status) || WSTOPSIG(status) != SIGTRAP) return count;
  }
}

// The child: makes its water, tells what the pass is modelled to do, stops, runs it once more, stops.
void run_once(int to_parent, const Pass& pass, double listed) {
  pass.prepare();
  pass.run();
  pass.prepare();
  ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  raise(SIGSTOP);
  pass.run();
  raise(SIGSTOP);
  const Work work = pass.work();
  Model model{{}, work.particles, listed, work.flops};
  std::snprintf(model.name, sizeof model.name, "%s", pass.name.c_str());
  if (write(to_parent, &model, sizeof model) < 0) _exit(1);
}

std::vector<Pass> all_passes(const std::shared_ptr<Water>& water, int with_bed, int with_friction) {
  if (with_bed) water->add_bed();
  if (with_friction) water->add_friction();
  const PassList list(water);
  return with_bed ? list.with_bed() : with_friction ? list.with_friction() : list.plain();
}

void report(const Count& count, const Model& model) {
  std::printf("%-22s %13.0f %12.1f %12.1f %8.2f %12.2f %10.2f\n", model.name,
              count.instructions / model.particles, count.flops / model.particles,
              model.flops / model.particles, model.flops / std::max(count.flops, 1.0),
              count.flops / model.listed, model.flops / model.listed);
}

// false: there is no such pass.
bool count_pass(int kind, std::size_t index) {
  int ends[2];
  if (pipe(ends) != 0) return false;
  const pid_t child = fork();
  if (child == 0) {
    const Runtime runtime(1);
    const auto water = std::make_shared<Water>(Arrangement::uniform, particles);
    const auto passes = all_passes(water, kind == 1, kind == 2);
    if (index >= passes.size()) _exit(3);
    run_once(ends[1], passes[index], water->listed());
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  bool found = false;
  if (WIFSTOPPED(status)) {
    const Count count = step_through(child);
    ptrace(PTRACE_CONT, child, nullptr, nullptr);
    Model model{};
    found = read(ends[0], &model, sizeof model) == sizeof model;
    if (found) report(count, model);
    waitpid(child, &status, 0);
  }
  close(ends[0]);
  close(ends[1]);
  return found;
}

}  // namespace

int main() {
  std::printf("%-22s %13s %12s %12s %8s %12s %10s\n", "pass, per particle", "instructions", "operations",
              "modelled", "of that", "listed pair", "modelled");
  for (int kind = 0; kind < 3; ++kind)
    for (std::size_t index = 0; count_pass(kind, index); ++index) std::fflush(stdout);
  return 0;
}
#else
int main() {
  std::fputs("instructions: counting needs Linux on x86-64\n", stderr);
  return 1;
}
#endif
