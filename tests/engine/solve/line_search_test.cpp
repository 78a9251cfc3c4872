#include "engine/solve/minimise/line_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

using Function = std::function<LinePoint(double)>;

constexpr int cases = 4000;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Σ over terms of weight·max(0, side·(t − place))^power. If `both` is true, weight·(t − place)^power instead.
Function powers(RandomStream& random, int terms, int power, bool both) {
  struct Term {
    double weight, place, side;
  };
  std::vector<Term> list;
  for (int k = 0; k < terms; ++k)
    list.push_back({decade(random, -2, 2), uniform(random, 0.1, 3), random.uniform() < 0.7 ? -1.0 : 1.0});
  list.front().side = -1;  // at least one term has its force away from 0
  return [list, power, both](double t) {
    LinePoint p{t, 0, 0};
    for (const Term& term : list) {
      const double x = both ? term.side * (t - term.place) : std::max(0.0, term.side * (t - term.place));
      p.value += term.weight * std::pow(x, power);
      p.slope += term.weight * power * std::pow(x, power - 1) * term.side;
    }
    return p;
  };
}

Function cosines(RandomStream& random) {
  struct Wave {
    double amplitude, number, phase;
  };
  std::vector<Wave> waves;
  for (int k = 0; k < 4; ++k)
    waves.push_back({uniform(random, 0, 1), uniform(random, 0.3, 5), uniform(random, 0, 6.3)});
  const double bowl = decade(random, -2, 0);
  return [waves, bowl](double t) {
    LinePoint p{t, bowl * (t - 1) * (t - 1), 2 * bowl * (t - 1)};
    for (const Wave& wave : waves) {
      p.value += wave.amplitude * std::cos(wave.number * t + wave.phase);
      p.slope -= wave.amplitude * wave.number * std::sin(wave.number * t + wave.phase);
    }
    return p;
  };
}

/// The function with other units of length and value, so that both span decades.
Function scaled(const Function& f, double length, double height) {
  return [=](double t) {
    const LinePoint p = f(t / length);
    return LinePoint{t, height * p.value, height / length * p.slope};
  };
}

constexpr std::array kinds{"quadratic", "quartic", "cosines", "kinks", "overlaps"};

struct Case {
  std::string name;
  Function at;
  double length = 1;  ///< minima are within a few of these lengths
  double first_step = 1;
  bool convex = true;
  LineSearchOptions options;
};

Case random_case(RandomStream& random, int k) {
  Case c;
  const std::size_t kind = static_cast<std::size_t>(k) % kinds.size();
  Function f;
  do {
    switch (kind) {
      case 0: f = powers(random, 1, 2, true); break;
      case 1: f = powers(random, 3, 4, true); break;
      case 2: f = cosines(random); break;
      case 3: f = powers(random, 5, 2, false); break;
      default: f = powers(random, 5, 6, false); break;
    }
  } while (!(f(0).slope < 0));
  c.length = decade(random, -3, 3);
  c.at = scaled(f, c.length, decade(random, -6, 3));
  c.first_step = c.length * decade(random, -3, 3);
  c.options.curvature = random.uniform() < 0.5 ? 0.1 : 0.9;
  c.options.longest_step = 1e5 * c.length;
  c.options.max_evaluations = 60;
  c.convex = kind != 2;
  c.name = std::string(kinds[kind]) + " #" + std::to_string(k);
  return c;
}

/// All evaluations of a search.
struct Trace {
  LineSearchResult result;
  std::vector<LinePoint> points;
  LinePoint start;
};

Trace search(const Case& c) {
  Trace trace;
  trace.start = c.at(0);
  const auto at = [&](double t) {
    trace.points.push_back(c.at(t));
    return trace.points.back();
  };
  trace.result = line_search(at, trace.start, c.first_step, c.options);
  return trace;
}

std::string seen(const Trace& trace) {
  std::ostringstream text;
  text.precision(17);
  text << "start value " << trace.start.value << " slope " << trace.start.slope;
  for (const LinePoint& p : trace.points) text << "\n  t " << p.step << " value " << p.value << " slope " << p.slope;
  text << "\n  returned t " << trace.result.point.step;
  return text.str();
}

/// Rounding error of the values that the search assumes.
double rounding(const Trace& trace) { return 4 * std::numeric_limits<double>::epsilon() * std::abs(trace.start.value); }

void expect_honest(const Case& c, const Trace& trace) {
  const LineSearchResult& result = trace.result;
  ASSERT_EQ(result.evaluations, static_cast<int>(trace.points.size())) << c.name;
  ASSERT_LE(result.evaluations, c.options.max_evaluations) << c.name;
  for (const LinePoint& p : trace.points) {
    ASSERT_GT(p.step, 0) << c.name << "\n" << seen(trace);
    ASSERT_LE(p.step, c.options.longest_step) << c.name << "\n" << seen(trace);
  }
  if (!result.found) return;
  ASSERT_GT(result.point.step, 0) << c.name << ": the start was returned as found\n" << seen(trace);
  ASSERT_LE(result.point.value, trace.start.value + std::max(c.options.noise, rounding(trace))) << c.name << "\n"
                                                                                                << seen(trace);
  EXPECT_TRUE(std::any_of(trace.points.begin(), trace.points.end(),
                          [&](const LinePoint& p) { return p.step == result.point.step; }))
      << c.name << ": returned a point that was never evaluated\n"
      << seen(trace);
  const LinePoint again = c.at(result.point.step);
  ASSERT_EQ(result.point.value, again.value) << c.name;
  ASSERT_EQ(result.point.slope, again.slope) << c.name;
}

void expect_strong_wolfe(const Case& c, const Trace& trace) {
  const LinePoint& p = trace.result.point;
  const double allowed = trace.start.value + c.options.decrease * p.step * trace.start.slope + rounding(trace);
  EXPECT_LE(p.value, allowed) << c.name << ": too small a decrease\n" << seen(trace);
  EXPECT_LE(std::abs(p.slope), c.options.curvature * std::abs(trace.start.slope)) << c.name << ": too steep\n"
                                                                                  << seen(trace);
}

TEST(LineSearch, FindsStrongWolfePoints) {
  RandomStream random{1};
  std::array<int, kinds.size()> evaluations{};
  for (int k = 0; k < cases; ++k) {
    const Case c = random_case(random, k);
    const Trace trace = search(c);
    ASSERT_TRUE(trace.result.found) << c.name << "\n" << seen(trace);
    expect_honest(c, trace);
    expect_strong_wolfe(c, trace);
    if (HasFatalFailure()) return;
    evaluations[static_cast<std::size_t>(k) % kinds.size()] += trace.result.evaluations;
  }
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    std::printf("%-9s %.1f evaluations a search\n", kinds[kind],
                static_cast<double>(evaluations[kind]) * static_cast<double>(kinds.size()) / cases);
}

TEST(LineSearch, RecoversFromTrialsThatAreNotFinite) {
  RandomStream random{3};
  int walls_met = 0;
  for (int k = 0; k < cases; ++k) {
    Case c = random_case(random, k);
    const Trace free = search(c);
    ASSERT_TRUE(free.result.found) << c.name;
    // Half of the walls, where values are not finite, are behind the minimum; the others are before it.
    const bool behind = random.uniform() < 0.5;
    const double wall = free.result.point.step * (behind ? uniform(random, 1.01, 2) : uniform(random, 0.2, 0.9));
    const int kind = static_cast<int>(3 * random.uniform());
    const double bad = kind == 0 ? infinite : std::numeric_limits<double>::quiet_NaN();
    const Function inner = c.at;
    c.at = [=](double t) {
      LinePoint p = inner(std::min(t, wall));
      p.step = t;
      if (t > wall && kind < 2) p.value = bad;
      if (t > wall && kind > 0) p.slope = bad;
      return p;
    };
    const Trace trace = search(c);
    ASSERT_TRUE(trace.result.found) << c.name << " wall " << wall << "\n" << seen(trace);
    expect_honest(c, trace);
    if (HasFatalFailure()) return;
    EXPECT_LE(trace.result.point.step, wall) << c.name << "\n" << seen(trace);
    // A function with several minima may decrease up to the wall, and the search may follow it there.
    if (behind && c.convex) expect_strong_wolfe(c, trace);
    walls_met +=
        std::any_of(trace.points.begin(), trace.points.end(), [&](const LinePoint& p) { return p.step > wall; });
  }
  EXPECT_GT(walls_met, cases / 4);
}

TEST(LineSearch, WorksBelowTheRoundingError) {
  RandomStream random{4};
  int found = 0, accepted_by_slope = 0;
  for (int k = 0; k < cases; ++k) {
    Case c = random_case(random, 5 * k);
    // The function is so flat that its changes are below the rounding errors of its values. Its slopes are exact.
    const double depth = -c.at(0).slope * c.length;
    const double noise = depth * decade(random, -2, 3), level = 1e3 * noise;
    const Function inner = c.at;
    const std::uint64_t salt = random.bits();
    c.at = [=](double t) {
      LinePoint p = inner(t);
      RandomStream jitter{salt, std::bit_cast<std::uint64_t>(t)};
      if (t != 0) p.value += noise * (jitter.uniform() - 0.5);
      p.value += level;
      return p;
    };
    c.options.noise = noise;
    c.options.longest_step = c.length * decade(random, -1, 2);
    const Trace trace = search(c);
    expect_honest(c, trace);
    if (HasFatalFailure()) return;
    found += trace.result.found;
    accepted_by_slope += trace.result.found && trace.result.point.value > trace.start.value;
  }
  std::printf("%d of %d searches in noise found a point, %d of them higher than the start\n", found, cases,
              accepted_by_slope);
  EXPECT_GT(found, cases / 2);
  EXPECT_GT(accepted_by_slope, 0);
}

}  // namespace
}  // namespace isojam
