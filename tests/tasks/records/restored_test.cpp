#include "tasks/records/restored.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tasks/io/input_error.hpp"
#include "tasks/measure/recorded_measurement.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/store.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

Manifest manifest_measuring(const Json& measures) {
  auto json = test::tiny_manifest();
  json["keep_path"] = true;
  json["measure"] = measures;
  return parse_manifest(json.dump(), "m.json");
}

/// An outcome that has one of each optional part of a step.
Outcome outcome_of(const ReplicateSpec& spec) {
  auto outcome = test::made_up_outcome(spec);
  std::erase_if(outcome.measured, [](const auto& each) { return each.first != Measure::contacts; });
  auto& path = outcome.jam.path;
  path[0].lost = true;
  path[1].rearrangement = Rearrangement{0.25, 7, 3, 12.5};
  path[1].summary.residual_floor = 1e-9;
  path[2].summary.residual = std::numeric_limits<double>::infinity();
  path[2].deviator = 0.125;
  path[3].descents = 2;
  path[3].summary.iterations = 17;
  outcome.jam.phi_j = fit_jamming_point(energy_points(outcome.jam), spec.options.decompression.fit_window);
  return outcome;
}

TEST(Restored, NothingIsAddedIfTheRecordDiffers) {
  const test::TemporaryDirectory here;
  const auto few = manifest_measuring({"contacts"});
  const Store store(here.path(), few, test::unheard);
  const auto spec = test::make_plan(few).front();
  const auto outcome = outcome_of(spec);
  store.write(outcome);
  const auto before = test::files_below(here.path());
  const auto held = read_record(here.path(), replicate_name(spec));

  auto added = outcome;
  added.spec = test::make_plan(manifest_measuring({"contacts", "order"})).front();
  added.measured[Measure::order].states.assign(outcome.jam.states.size(), Json::object());
  const std::vector<std::pair<const char*, std::function<void(Outcome&)>>> differences{
      {"a branch that was lost", [](Outcome& o) { o.jam.path[0].lost = false; }},
      {"a packing that rearranged", [](Outcome& o) { o.jam.path[1].rearrangement.reset(); }},
      {"the last digit of an energy", [](Outcome& o) { o.jam.path[2].energy_per_particle *= 1 + 1e-15; }},
      {"work", [](Outcome& o) { ++o.jam.evaluations; }},
      {"a measure that was there", [](Outcome& o) { o.measured[Measure::contacts].states[0]["contacts"]["Z"] = 1.5; }}};
  for (const auto& [what, differ] : differences) {
    auto other = added;
    differ(other);
    EXPECT_THROW(store.write_added(other, held, false), InputError) << what;
    EXPECT_EQ(test::files_below(here.path()), before) << what;
  }
  EXPECT_NO_THROW(store.write_added(added, held, false));
  EXPECT_NE(test::files_below(here.path()), before);
}

}  // namespace
}  // namespace isojam
