#include "tests/bench/thread_scaling.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "shapes/any_shape.h"
#include "tests/bench/bench_pairs.h"
#include "tests/bench/rounds.h"

namespace vex {
namespace {

void require(bool works) {
  if (!works) throw std::runtime_error("the system refused a process or a pipe");
}

// Wall nanoseconds of a run, after a short one that fills caches.
double run_ns(const ConvexBody& body, const MonteCarloSettings& settings) {
  MonteCarloSettings warm_up = settings;
  warm_up.stop.trials = std::min<std::uint64_t>(*settings.stop.trials, 1 << 16);
  run_monte_carlo(body, body, warm_up);
  const double start = wall_ns();
  run_monte_carlo(body, body, settings);
  return wall_ns() - start;
}

// The child's side: says that it is ready, waits for the word, runs, and writes how long it took.
[[noreturn]] void be_process(const ConvexBody& body, const MonteCarloSettings& settings, int go, int done) {
  int exit_code = 1;
  try {
    MonteCarloSettings warm_up = settings;
    warm_up.stop.trials = std::min<std::uint64_t>(*settings.stop.trials, 1 << 16);
    run_monte_carlo(body, body, warm_up);
    char byte = 0;
    if (write(done, &byte, 1) == 1 && read(go, &byte, 1) == 1) {
      const double start = wall_ns();
      run_monte_carlo(body, body, settings);
      const double taken = wall_ns() - start;
      if (write(done, &taken, sizeof(taken)) == static_cast<ssize_t>(sizeof(taken))) exit_code = 0;
    }
  } catch (...) {
    exit_code = 1;
  }
  _exit(exit_code);
}

// Wall nanoseconds of each of n processes that begin at one word.
std::vector<double> processes_ns(const ConvexBody& body, MonteCarloSettings settings, int n) {
  struct Child {
    pid_t id;
    int done;  // where it writes
  };
  std::array<int, 2> go{};
  require(pipe(go.data()) == 0);
  std::vector<Child> children;
  for (int k = 0; k < n; ++k) {
    std::array<int, 2> done{};
    require(pipe(done.data()) == 0);
    settings.seed += 1;
    const pid_t id = fork();  // safe: threads of runs before have ended
    require(id >= 0);
    if (id == 0) be_process(body, settings, go[0], done[1]);
    close(done[1]);
    children.push_back({id, done[0]});
  }
  bool works = true;
  char byte = 0;
  for (const Child& child : children) works = read(child.done, &byte, 1) == 1 && works;
  for (int k = 0; k < n; ++k) works = write(go[1], &byte, 1) == 1 && works;
  std::vector<double> all;
  for (const Child& child : children) {
    double taken = 0.0;
    works = read(child.done, &taken, sizeof(taken)) == static_cast<ssize_t>(sizeof(taken)) && works;
    int status = 0;
    works = waitpid(child.id, &status, 0) == child.id && status == 0 && works;
    close(child.done);
    all.push_back(taken);
  }
  close(go[0]);
  close(go[1]);
  require(works);
  return all;
}

}  // namespace

BenchReport thread_scaling(const BenchSettings& settings) {
  const ConvexBody cube = parse_shape("box:1,1,1").body;
  const std::size_t n_each = settings.n_poses.value_or(10'000'000);
  const auto n_threads = static_cast<std::size_t>(settings.n_threads);
  MonteCarloSettings alone = trial_settings(cube, settings.seed, n_each);
  MonteCarloSettings together = trial_settings(cube, settings.seed, n_threads * n_each);
  together.n_threads = settings.n_threads;
  // Trials a wall nanosecond. Of processes the sum of their rates, so that nobody waits for the last.
  Timing threads, processes, one;
  for (int round = 0; round < settings.n_rounds; ++round) {
    const auto take_threads = [&] {
      threads.ns.push_back(run_ns(cube, together) / static_cast<double>(n_threads * n_each));
    };
    const auto take_processes = [&] {
      double rate = 0.0;
      for (const double taken : processes_ns(cube, alone, settings.n_threads))
        rate += static_cast<double>(n_each) / taken;
      processes.ns.push_back(1.0 / rate);
    };
    if (round % 2 == 0) take_threads();
    take_processes();
    if (round % 2 != 0) take_threads();
    one.ns.push_back(run_ns(cube, alone) / static_cast<double>(n_each));
  }
  const double share = ratio(processes, threads);
  MarkdownTable table({"cubes", "wall ns a trial", "trials a second"});
  const auto add = [&](const std::string& name, const Timing& timing) {
    table.add({name, timing_text(timing), grouped(static_cast<std::uint64_t>(1e9 / timing.median()))});
  };
  const std::string n = std::to_string(n_threads);
  add("one process, " + n + " threads", threads);
  add(n + " processes together, one thread each", processes);
  add("one process, one thread, nothing beside it", one);
  return {"### Threads\n\n" + grouped(n_threads * n_each) + " trials a turn on either side, " +
              std::to_string(settings.n_rounds) +
              " rounds; the median, in brackets what lies between the quartiles.\n\n" + table.text() + "\nThreads do " +
              percent(share) + " of what processes do (asked for: 95 %).\n",
          {{{"trials", n_threads * n_each},
            {"threads", timing_json(threads)},
            {"processes", timing_json(processes)},
            {"one_thread_alone", timing_json(one)},
            {"threads_of_processes", share},
            {"goal", 0.95}}}};
}

}  // namespace vex
