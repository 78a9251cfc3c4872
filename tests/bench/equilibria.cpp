// Cost of following equilibria towards jamming, printed as tables:
//
//   isojam_equilibria states N SEEDS [newton]
//     Every expansion step of 35 % and one of 3 % from the same state, for the four solids of the paper. With `newton`
//     also by Newton's method, and whether the energies agree.
//   isojam_equilibria law N[:STATES]...
//     Whole replicates of octahedra to Δφ = 0.005, or to the given number of states: cost as a function of N.
//
// One thread, from φ = 0.05; seeds 1 … SEEDS; times are CPU seconds.

#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "engine/solve/jam.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "engine/solve/rearrangement.hpp"

namespace isojam::bench {
namespace {

constexpr double final_distance = 0.005, large_step = 0.35, small_step = 0.03;

/// CPU seconds of this process. Other programs affect them only through the caches.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double distance_of(const Packing& packing, const Evaluation& value) {
  return 6 * value.energy / packing.size() * packing.density() * packing.density() / value.pressure;
}

Packing placed(SolidKind kind, int n, int seed, const JamOptions& options) {
  RandomStream random{static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(kind),
                      static_cast<std::uint64_t>(n)};
  return random_packing(platonic(kind), n, options.compression.initial_density, random);
}

/// Costs of all steps of one kind.
struct Costs {
  std::vector<double> hessians, local, envelopes, overlaps, seconds;
  int failed = 0;

  void add(const MinimiseSummary& summary, double time) {
    hessians.push_back(static_cast<double>(summary.work.hessians));
    local.push_back(static_cast<double>(summary.work.local_factorisations));
    envelopes.push_back(static_cast<double>(summary.work.envelopes));
    overlaps.push_back(static_cast<double>(summary.work.envelope_overlaps));
    seconds.push_back(time);
    failed += !is_equilibrium(summary);
  }
  void add(const Costs& more) {
    const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(hessians, more.hessians), append(local, more.local), append(envelopes, more.envelopes);
    append(overlaps, more.overlaps), append(seconds, more.seconds);
    failed += more.failed;
  }
  void print(const char* what) const {
    double worst = 0, sum = 0;
    for (const double count : hessians) worst = std::max(worst, count);
    for (const double time : seconds) sum += time;
    std::printf("  %-28s %4zu %8.0f %8.0f %8.0f %8.0f %10.0f %9.3f %9.1f %5d\n", what, hessians.size(),
                median(hessians), worst, median(local), median(envelopes), median(overlaps), median(seconds), sum,
                failed);
    std::fflush(stdout);
  }
};

struct Comparison {
  Costs large, small, newton;
  int compared = 0, same = 0;
};

MinimiseSummary timed_follow(const Packing& from, double distance, double ratio, Costs& costs) {
  Packing packing = from;
  PackingEnergy energy;
  const double begin = now();
  const MinimiseSummary summary =
      follow_equilibrium(packing, packing.density() - ratio * distance, distance, energy, {});
  costs.add(summary, now() - begin);
  return summary;
}

void compare(const Packing& state, bool with_newton, Comparison& found) {
  const Evaluation value = PackingEnergy().evaluate(state, Precision::double_double);
  const double distance = distance_of(state, value);
  timed_follow(state, distance, small_step, found.small);
  const MinimiseSummary followed = timed_follow(state, distance, large_step, found.large);
  if (!with_newton) return;
  Packing packing = strained_to(state, state.density() - large_step * distance);
  PackingEnergy energy;
  MinimiseOptions options;
  options.method = Method::newton;
  const double begin = now();
  const MinimiseSummary summary = minimise(packing, energy, options);
  found.newton.add(summary, now() - begin);
  if (!is_equilibrium(summary) || !is_equilibrium(followed)) return;
  ++found.compared;
  found.same += std::abs(followed.energy / summary.energy - 1) < 1e-6;
}

/// Decompresses a packing with the default protocol, and measures both steps from every state with Δφ < 0.13.
void states_of(SolidKind kind, int n, int seed, bool with_newton, Comparison& found) {
  JamOptions options;
  options.decompression.final_distance = final_distance;
  JamProgress progress = begin_jam(placed(kind, n, seed, options), options);
  std::size_t seen = 0;
  while (!progress.ended()) {
    advance(progress, options);
    const std::vector<Packing>& states = progress.result.states;
    if (states.size() > seen && distance_to_jamming(progress.result.path.back()) < 0.13 &&
        distance_to_jamming(progress.result.path.back()) > final_distance)
      compare(states.back(), with_newton, found);
    seen = states.size();
  }
}

void states(int n, int seeds, bool with_newton) {
  std::printf("N = %d, seeds 1 … %d\n  %-28s %4s %8s %8s %8s %8s %10s %9s %9s %5s\n", n, seeds, "step", "n", "Hessians",
              "most", "local", "sweeps", "overlaps", "s", "s in all", "fail");
  Comparison all;
  for (const SolidKind kind :
       {SolidKind::tetrahedron, SolidKind::octahedron, SolidKind::dodecahedron, SolidKind::icosahedron}) {
    Comparison found;
    for (int seed = 1; seed <= seeds; ++seed) states_of(kind, n, seed, with_newton, found);
    const std::string name(to_string(kind));
    found.large.print((name + ", 35 %").c_str());
    found.small.print((name + ", 3 %").c_str());
    if (with_newton) {
      found.newton.print((name + ", 35 %, newton").c_str());
      std::printf("  same energy to 1e-6: %d of %d\n", found.same, found.compared);
    }
    all.large.add(found.large), all.small.add(found.small), all.newton.add(found.newton);
    all.same += found.same, all.compared += found.compared;
  }
  all.large.print("all, 35 %");
  all.small.print("all, 3 %");
  if (!with_newton) return;
  all.newton.print("all, 35 %, newton");
  std::printf("  same energy to 1e-6: %d of %d\n", all.same, all.compared);
}

double peak_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1024 * 1024);
}

/// A packing whose cost is measured.
struct Task {
  int particles = 0;
  std::size_t states = 0;  ///< decompression ends after so many states; 0: at final_distance
};

/// CPU seconds of both stages of a replicate.
struct StageTimes {
  double compression = 0, decompression = 0;
};

JamProgress jammed(const Task& task, StageTimes& times) {
  JamOptions options;
  options.decompression.final_distance = final_distance;
  JamProgress progress = begin_jam(placed(SolidKind::octahedron, task.particles, 1, options), options);
  while (!progress.ended() && (task.states == 0 || progress.result.states.size() < task.states)) {
    const double before = now();
    double& sum = progress.stage == JamStage::decompression ? times.decompression : times.compression;
    advance(progress, options);
    sum += now() - before;
  }
  return progress;
}

void law(const std::vector<Task>& tasks) {
  std::printf("%6s %8s %6s %8s %10s %8s %8s %11s %13s %8s %8s  %s\n", "N", "φ_J", "states", "Hessians", "incomplete",
              "complete", "local", "compression", "decompression", "s in all", "peak GiB", "ended");
  std::vector<double> n, seconds;
  for (const Task& task : tasks) {
    StageTimes times;
    const JamProgress progress = jammed(task, times);
    const JamResult& result = progress.result;
    const MinimiseWork& work = result.work;
    std::printf("%6d %7.5f %6zu %8ld %10ld %8ld %8ld %11.1f %13.1f %8.1f %8.2f  %s\n", task.particles,
                result.phi_j ? result.phi_j->density : 0, result.states.size(), work.hessians,
                work.incomplete_factorisations, work.factorisations, work.local_factorisations, times.compression,
                times.decompression, times.compression + times.decompression, peak_gib(),
                progress.ended() ? to_string(result.status).data() : "by the number of states");
    std::fflush(stdout);
    if (task.states > 0) continue;
    if (!n.empty())
      std::printf("%6s exponent of the decompression from N = %.0f: %.2f\n", "", n.back(),
                  std::log(times.decompression / seconds.back()) / std::log(task.particles / n.back()));
    n.push_back(task.particles);
    seconds.push_back(times.decompression);
  }
}

/// The number in the text, or 0 if the text is not a number.
int number(const std::string& text) {
  const int value = std::atoi(text.c_str());
  return std::to_string(value) == text ? value : 0;
}

/// The task in a text N or N:STATES; N is 0 if the text is neither.
Task task_in(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {number(text), 0};
  const int states = number(text.substr(colon + 1));
  return states > 0 ? Task{number(text.substr(0, colon)), static_cast<std::size_t>(states)} : Task{};
}

int run(const std::vector<std::string>& arguments) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const bool newton = arguments.size() == 4 && arguments[3] == "newton";
  std::vector<Task> tasks;
  for (std::size_t k = 1; k < arguments.size() - newton; ++k) tasks.push_back(task_in(arguments[k]));
  const bool valid =
      !tasks.empty() && std::all_of(tasks.begin(), tasks.end(), [](const Task& task) { return task.particles > 0; });
  if (valid && arguments[0] == "states" && tasks.size() == 2) {
    states(tasks[0].particles, tasks[1].particles, newton);
  } else if (valid && arguments[0] == "law") {
    law(tasks);
  } else {
    std::fprintf(stderr, "usage: isojam_equilibria states N SEEDS [newton] | isojam_equilibria law N[:STATES]...\n");
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace isojam::bench

int main(int count, char** values) {
  try {
    return isojam::bench::run({values + 1, values + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
