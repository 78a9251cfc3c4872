// A step of YADE beside an evaluation of the same equilibrium of 100 particles, on one core.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <map>
#include <numbers>

#include "engine/analysis/contact_force.hpp"
#include "engine/packing/energy.hpp"
#include "tests/bench/peers.hpp"
#include "tests/bench/states.hpp"

namespace isojam::bench {
namespace {

using Pairs = std::map<std::pair<int, int>, YadeContact>;

void isojam(benchmark::State& state, SolidKind kind) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const Packing& packing = jammed(kind, 100, .02);
  PackingEnergy energy;
  double contacts = 0;
  for (auto _ : state) contacts += static_cast<double>(energy.evaluate(packing).contacts);
  state.counters["seconds_per_contact"] = seconds_per(contacts);
}

/// Compares the contacts of YADE with those of isojam: the number that YADE misses and their share of all forces, pairs
/// that do not touch, and the median and the largest angle between the force and −∇E.
void compare(benchmark::State& state, const Packing& packing, Pairs theirs) {
  const std::vector<Contact> contacts = PackingEnergy().contacts(packing);
  const std::vector<ContactForce> forces = contact_forces(packing, contacts);
  double missed = 0, force = 0, missed_force = 0;
  std::vector<double> angles;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double size = forces[k].force_a.norm();
    force += size;
    const auto found = theirs.extract({contacts[k].pair.a, contacts[k].pair.b});
    if (!found) {
      ++missed, missed_force += size;
      continue;
    }
    const Eigen::Vector3d direction = found.mapped().force.normalized();
    angles.push_back(std::asin(std::min(1.0, direction.cross(forces[k].normal).norm())) * 180 / std::numbers::pi);
  }
  std::ranges::sort(angles);
  state.counters["contacts"] = static_cast<double>(contacts.size());
  state.counters["missed"] = missed;
  state.counters["missed_force"] = missed_force / force;
  state.counters["false"] = static_cast<double>(theirs.size());
  state.counters["median_angle"] = angles[angles.size() / 2];
  state.counters["largest_angle"] = angles.back();
}

void yade(benchmark::State& state, SolidKind kind) {
  const Packing& packing = jammed(kind, 100, .02);
  YadeStep step;
  double contacts = 0;
  for (auto _ : state) {
    step = yade_step(packing);
    state.SetIterationTime(step.seconds);
    contacts += static_cast<double>(step.contacts.size());
  }
  state.counters["seconds_per_contact"] = seconds_per(contacts);
  state.counters["left"] = step.left;
  Pairs pairs;
  for (const YadeContact& contact : step.contacts) pairs.emplace(std::minmax(contact.a, contact.b), contact);
  compare(state, packing, std::move(pairs));
}

[[maybe_unused]] const bool registered = [] {
  for (const SolidKind kind :
       {SolidKind::tetrahedron, SolidKind::octahedron, SolidKind::dodecahedron, SolidKind::icosahedron}) {
    const std::string name(to_string(kind));
    benchmark::RegisterBenchmark(("packing/isojam/" + name).c_str(), isojam, kind);
    benchmark::RegisterBenchmark(("packing/yade/" + name).c_str(), yade, kind)
        ->Iterations(1)
        ->Repetitions(1)
        ->UseManualTime();
  }
  return true;
}();

}  // namespace
}  // namespace isojam::bench
