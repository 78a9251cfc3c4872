// Cost of following equilibria towards jamming, printed as tables:
//
//   isojam_equilibria states N SEEDS [newton]
//     Every expansion step of 35 % and one of 3 % from the same state, for the four solids of the paper. With `newton`
//     also by Newton's method, and whether the energies agree.
//   isojam_equilibria law N...
//     Whole replicates of octahedra to Δφ = 0.005: cost as a function of N.
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

void law(const std::vector<int>& sizes) {
  std::printf("%6s %10s %7s %8s %8s %10s %10s %9s  %s\n", "N", "φ_J", "states", "Hessians", "local", "expand s",
              "in all s", "peak GiB", "ended");
  std::vector<double> n, seconds;
  for (const int size : sizes) {
    JamOptions options;
    options.decompression.final_distance = final_distance;
    JamProgress progress = begin_jam(placed(SolidKind::octahedron, size, 1, options), options);
    const double begin = now();
    double expanding = 0;
    while (!progress.ended()) {
      const double before = now();
      const bool expands = progress.stage == JamStage::expansion;
      advance(progress, options);
      if (expands) expanding += now() - before;
    }
    const JamResult& result = progress.result;
    std::printf("%6d %10.5f %7zu %8ld %8ld %10.1f %10.1f %9.2f  %s\n", size, result.phi_j ? result.phi_j->density : 0,
                result.states.size(), result.work.hessians, result.work.local_factorisations, expanding, now() - begin,
                peak_gib(), to_string(result.status).data());
    std::fflush(stdout);
    if (!n.empty())
      std::printf("%6s exponent from N = %.0f: %.2f\n", "", n.back(),
                  std::log(expanding / seconds.back()) / std::log(size / n.back()));
    n.push_back(size);
    seconds.push_back(expanding);
  }
}

/// The number in the text, or 0 if the text is not a number.
int number(const std::string& text) {
  const int value = std::atoi(text.c_str());
  return std::to_string(value) == text ? value : 0;
}

int run(const std::vector<std::string>& arguments) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  std::vector<int> numbers;
  const bool newton = arguments.size() == 4 && arguments[3] == "newton";
  for (std::size_t k = 1; k < arguments.size() - newton; ++k) numbers.push_back(number(arguments[k]));
  const bool valid = !numbers.empty() && *std::min_element(numbers.begin(), numbers.end()) > 0;
  if (valid && arguments[0] == "states" && numbers.size() == 2) {
    states(numbers[0], numbers[1], newton);
  } else if (valid && arguments[0] == "law") {
    law(numbers);
  } else {
    std::fprintf(stderr, "usage: isojam_equilibria states N SEEDS [newton] | isojam_equilibria law N...\n");
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
