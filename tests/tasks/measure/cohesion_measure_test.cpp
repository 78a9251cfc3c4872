#include <gtest/gtest.h>

#include "engine/analysis/cohesive_contacts.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/restored.hpp"
#include "tasks/records/summary.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

/// A specification with large steps. With cohesion of this strength, it acts until the end; otherwise there are two
/// training cycles.
ReplicateSpec spec_of(double strength) {
  Json manifest{{"name", "cohesive"},
                {"seed", 7},
                {"sweep", {{"solid", {"octahedron"}}, {"particles", {64}}}},
                {"replicates", 1},
                {"measure", {"contacts", "order", "clusters", "percolation"}}};
  Json& protocol = manifest["protocol"];
  protocol = {{"initial_density", 0.2}, {"compression_step", 0.03}, {"final_distance", 0.02}, {"fit_window", 0.06}};
  if (strength > 0) {
    protocol["target_energy"] = 1e-8;
    protocol["cohesion"] = {{"strength", strength}, {"until", "end"}};
  } else {
    protocol["cycles"] = 2;
  }
  return test::make_plan(parse_manifest(manifest.dump(), "m.json")).front();
}

/// The outcome of the replicate, as the task graph computes it.
const Outcome& outcome_of(double strength) {
  static std::map<double, Outcome> all;
  const auto [place, is_new] = all.try_emplace(strength);
  Outcome& outcome = place->second;
  if (!is_new) return outcome;
  const Stages stages = engine_stages();
  outcome.spec = spec_of(strength);
  outcome.jam = stages.jam(outcome.spec, stages.begin(outcome.spec).progress, {}, {});
  for (const auto what : outcome.spec.measures)
    outcome.measured[what] = stages.measure(outcome.spec, what, outcome.jam);
  outcome.failure = failure_of(outcome.jam);
  return outcome;
}

TEST(CohesionMeasure, RecordsTheDensityAtZeroPressure) {
  const auto& outcome = outcome_of(1e-4);
  ASSERT_FALSE(outcome.failure) << outcome.failure->why;
  const Json record = test::record_on_disk(outcome);
  EXPECT_EQ(test::violations("record", record), "");
  const double density = outcome.jam.states.front().density();
  std::printf("phi_0 %.4f, Z %.2f, Z_grown %.2f\n", density,
              record.at("/states/0/contacts/Z"_json_pointer).get<double>(),
              record.at("/states/0/contacts/Z_grown"_json_pointer).get<double>());
  EXPECT_EQ(record.at("phi_0").get<double>(), density);
  EXPECT_TRUE(record.at("/phi_j/phi_j"_json_pointer).is_null());
  EXPECT_TRUE(record.at("flags").empty());
  EXPECT_EQ(record.at("states").size(), 1U);
  const RecordSummary summary = summarise_record(record, "record.json");
  EXPECT_EQ(summary.values[*quantity_index("phi_0")], density);
  EXPECT_FALSE(summary.values[*quantity_index("phi_j")]);
  EXPECT_GT(summary.values[*quantity_index("Z_grown")].value_or(0), summary.values[*quantity_index("Z")].value_or(9));
  EXPECT_LE(summary.residual.value_or(1), outcome.spec.options.minimise.residual);
}

TEST(CohesionMeasure, IsTheSameFromTheRecord) {
  const auto& outcome = outcome_of(1e-4);
  const Json record = test::record_on_disk(outcome);
  const JamResult again =
      restored_jam(read_record_document(record, "record.json"), outcome.jam.states, outcome.spec, "record.json");
  EXPECT_EQ(again.status, JamStatus::zero_pressure);
  for (const auto what : outcome.spec.measures)
    EXPECT_EQ(measure(what, again, measure_options(outcome.spec)).states, outcome.measured.at(what).states);
}

TEST(CohesionMeasure, MarksContactsUnderTension) {
  const auto& outcome = outcome_of(1e-4);
  const Packing& packing = outcome.jam.states.front();
  const std::vector<Contact> contacts = PackingEnergy().contacts(packing);
  const CohesiveContacts cohesive = cohesive_contacts(packing, contacts, outcome.spec.options.cohesion);
  const Json& json = outcome.measured.at(Measure::contacts).states.front().at("contacts");
  EXPECT_EQ(json.at("Z_grown").get<double>(), 2.0 * static_cast<double>(cohesive.grown) / packing.size());
  std::size_t pulled = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!cohesive.tension[k]) continue;
    EXPECT_EQ(json.at("under_tension").at(pulled), Json({contacts[k].pair.a, contacts[k].pair.b}));
    ++pulled;
  }
  EXPECT_EQ(json.at("under_tension").size(), pulled);
  EXPECT_NEAR(json.at("tension").get<double>(), static_cast<double>(pulled) / static_cast<double>(contacts.size()),
              1e-15);
}

TEST(CohesionMeasure, RecordsCycles) {
  const auto& outcome = outcome_of(0);
  ASSERT_EQ(outcome.jam.cycles.size(), 2U);
  const Json record = test::record_on_disk(outcome);
  EXPECT_EQ(record.at("cycles").size(), 2U);
  EXPECT_EQ(record.at("spec").at("protocol").at("cycles"), 2);
  const JamResult again =
      restored_jam(read_record_document(record, "record.json"), outcome.jam.states, outcome.spec, "record.json");
  ASSERT_EQ(again.cycles.size(), 2U);
  PackingEnergy energy;
  for (std::size_t k = 0; k < 2; ++k) {
    const Cycle& cycle = outcome.jam.cycles[k];
    EXPECT_EQ(record.at("cycles")[k].at("phi_j").get<double>(), cycle.phi_j.value_or(0));
    EXPECT_EQ(again.cycles[k].phi_j, cycle.phi_j);
    EXPECT_EQ(again.cycles[k].energy_per_particle, cycle.energy_per_particle);
    const Json& contacts = record.at("contacts").at("cycles").at(k);
    const auto analysis = classified_contacts(cycle.nearest.value(), energy).analysis;
    EXPECT_EQ(contacts.at("Z").get<double>(), analysis.numbers.Z);
    EXPECT_EQ(contacts.at("Z_ff").is_null(), !analysis.face_face.has_cutoff());
  }
  EXPECT_EQ(measure(Measure::contacts, again, {}).replicate.at("contacts").at("cycles").at(0).at("Z_reason"),
            "the last state of the cycle is not known");
}

TEST(CohesionMeasure, HasTheClustersOfTheOtherMeasures) {
  for (const double strength : {0.0, 1e-4}) {
    const auto& outcome = outcome_of(strength);
    for (std::size_t k = 0; k < outcome.jam.states.size(); ++k) {
      const Json& clusters = outcome.measured.at(Measure::clusters).states[k].at("clusters");
      const Json& all = outcome.measured.at(Measure::percolation).states[k].at("percolation");
      const Json& contacts = outcome.measured.at(Measure::contacts).states[k].at("contacts");
      const double particles = outcome.jam.states[k].size();
      for (const auto& [method, Z_ff] :
           {std::pair{"fit", contacts.at("Z_ff")}, std::pair{"trough", contacts.at("trough").at("Z_ff")}}) {
        const Json& found = all.at(method);
        EXPECT_EQ(found.at("S").is_null(), Z_ff.is_null()) << method;
        if (Z_ff.is_null()) continue;
        EXPECT_NEAR(2 * found.at("bonds").get<double>() / particles, Z_ff.get<double>(), 1e-12) << method;
        EXPECT_GE(found.at("random").at("S").get<double>(), 1) << method;
        EXPECT_GE(found.at("random").at("winds"), found.at("random").at("winds_in_two")) << method;
      }
      if (clusters.at("S").is_null()) continue;
      EXPECT_NEAR(all.at("fit").at("S").get<double>(), clusters.at("S").get<double>(), 1e-12);
      EXPECT_EQ(all.at("fit").at("winding_rank"), clusters.at("winding_rank"));
      EXPECT_NEAR(all.at("fit").at("largest").get<double>() * particles, clusters.at("largest").get<double>(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace isojam
