#include "tasks/tables/aggregate.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/summary.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tasks/io/input_error.hpp"
#include "tasks/tables/tables.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

std::vector<ReplicateSpec> plan(const std::function<void(Json&)>& change = {}) {
  auto manifest = test::good_manifest();
  manifest["sweep"]["solid"] = {"octahedron", "tetrahedron"};
  manifest["sweep"]["particles"] = {200, 100};
  manifest["sweep"]["target_energy"] = {1e-6, 1e-5};
  manifest["replicates"] = 5;
  if (change) change(manifest);
  return test::make_plan(parse_manifest(manifest.dump(), "m"));
}

RecordSummary summary_of(const Outcome& outcome) { return summarise_record(make_record(outcome), "made up"); }

std::vector<RecordSummary> summaries() {
  std::vector<RecordSummary> all;
  for (const auto& spec : plan()) all.push_back(summary_of(test::made_up_outcome(spec)));
  return all;
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

#if !defined(__SANITIZE_ADDRESS__)
#endif

TEST(Aggregate, OrderAndRepetitionDoNotMatter) {
  auto records = summaries();
  const auto table = pretty(to_json(aggregate(records)));
  records.insert(records.end(), records.begin(), records.begin() + 7);
  for (unsigned trial = 0; trial < 5; ++trial) {
    std::shuffle(records.begin(), records.end(), std::mt19937(trial));
    EXPECT_EQ(pretty(to_json(aggregate(records))), table);
  }
}

TEST(Aggregate, CountsFailedAndFlagged) {
  const auto specs = plan();
  std::vector<RecordSummary> records;
  double expected_sum = 0, worst = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    auto outcome = test::made_up_outcome(specs[i]);
    if (i == 1) outcome.failure = Failure{"jam", "made up"};
    if (i == 2) outcome.jam.status = JamStatus::goal_not_reached;
    if (i == 3) {
      auto undecided = test::made_up_contacts(9);
      undecided.edge_face.verdict = FitVerdict::too_few;
      test::set_nearest_contacts(outcome, undecided);
    }
    if (i != 1) {
      expected_sum += outcome.jam.phi_j->density;
      for (const auto& step : outcome.jam.path) worst = std::max(worst, step.summary.residual);
    }
    records.push_back(summary_of(outcome));
  }
  const auto row = aggregate(records, {}, {Flag::goal_not_reached}).rows.at(0);
  EXPECT_EQ(row.replicates, 5);
  EXPECT_EQ(row.failed, 1);
  EXPECT_EQ(row.flagged, 2);
  EXPECT_EQ(row.excluded, 1);
  std::map<std::string_view, int> n;
  for (std::size_t i = 0; i < all_quantities().size(); ++i) {
    if (is_always_listed(all_quantities()[i])) n[all_quantities()[i].name] = row.all[i].n;
  }
  const std::map<std::string_view, int> expected{{"phi_j", 4}, {"Z", 4},   {"Z_ff", 4},
                                                 {"Z_ef", 3},  {"Z_l", 3}, {"C", 3}};
  EXPECT_EQ(n, expected);
  EXPECT_NEAR(*row.all[0].mean, expected_sum / 4, 1e-15);
  EXPECT_EQ(row.estimates[0].n, 3);
  const double kept = expected_sum - test::made_up_outcome(specs[2]).jam.phi_j->density;
  EXPECT_NEAR(*row.estimates[0].mean, kept / 3, 1e-15);
  EXPECT_EQ(row.residual, worst);
}

TEST(Aggregate, SeriesInterpolateInTheLogarithmAndNeverExtrapolate) {
  const auto z = quantity_index("Z").value();
  RecordSummary record;
  record.particles = 100;
  std::vector<RecordSummary> records;
  // Z = a + b ln Δφ is interpolated exactly, wherever the states are.
  const auto law = [](int replicate, double distance) { return 9 + 0.1 * replicate + 0.3 * std::log(distance); };
  const std::vector<std::vector<double>> distances{{.003, .011, .07}, {.0049, .0051, .2}, {.021, .039}, {.01}};
  for (int k = 0; k < 4; ++k) {
    record.replicate = k;
    record.states.clear();
    for (const double distance : distances[static_cast<std::size_t>(k)]) {
      record.states.push_back({distance});
      record.states.back().values[z] = law(k, distance);
    }
    if (k == 1) record.states[1].values[z].reset();
    records.push_back(record);
  }
  const auto series = aggregate(records).rows.at(0).series;
  // Replicate 1 lacks the value between its outer states. The states of replicate 2 enclose no point. Replicate 3 has
  // one state.
  std::vector<std::pair<double, std::vector<int>>> expected{{.04, {0}}, {.02, {0}}, {.01, {0}}, {.005, {0}}};
  ASSERT_EQ(series.size(), expected.size());
  for (std::size_t p = 0; p < expected.size(); ++p) {
    EXPECT_EQ(series[p].delta_phi, expected[p].first);
    EXPECT_EQ(series[p].estimates[z].n, 1) << expected[p].first;
    EXPECT_NEAR(*series[p].estimates[z].mean, law(0, expected[p].first), 1e-14) << expected[p].first;
    EXPECT_EQ(series[p].estimates[quantity_index("phi_j").value()].n, 0);
  }
  const auto text = to_text(aggregate(records), View::series);
  EXPECT_NE(text.find(" 0.02 "), std::string::npos) << text;
}

TEST(Aggregate, OnlyTheQuantityOfAStoppingRuleHasSteinsInterval) {
  RecordSummary record;
  record.particles = 100;
  std::vector<RecordSummary> records;
  const std::vector<double> values{0.70, 0.66, 0.68, 0.61, 0.72, 0.65};
  for (record.replicate = 0; record.replicate < 6; ++record.replicate) {
    record.values[0] = values[static_cast<std::size_t>(record.replicate)];
    record.values[*quantity_index("Z")] = 10 * *record.values[0];
    record.values[*quantity_index("percolates")] = record.replicate % 2;
    records.push_back(record);
  }
  const auto json = [&](const Replicates& rule) { return to_json(aggregate(records, rule).rows.at(0)); };
  const auto fixed = json({6, 6, {}});
  const auto sequential = json({4, 6, Goal{"phi_j", 0.01}});
  EXPECT_EQ(sequential.at("phi_j").at("interval"), "stein");
  EXPECT_EQ(sequential.at("phi_j").at("half_width"), *stein_half_width({0.70, 0.66, 0.68, 0.61}, 6));
  EXPECT_EQ(sequential.at("phi_j").at("half_width"), sequential.at("goal").at("reached"));
  EXPECT_EQ(sequential.at("goal").at("first"), 4);
  EXPECT_EQ(sequential.at("Z"), fixed.at("Z"));
  EXPECT_EQ(fixed.at("phi_j").at("half_width"), *student_half_width(values));
  EXPECT_FALSE(fixed.at("phi_j").contains("interval"));
  EXPECT_EQ(json({6, 6, Goal{"phi_j", 0.01}}).at("phi_j"), fixed.at("phi_j")) << "one check is no sequence";
  EXPECT_EQ(fixed.at("percolates").at("interval"), "wilson");
  EXPECT_EQ(json({4, 6, Goal{"percolates", 0.01}}).at("percolates"), fixed.at("percolates"));
}

TEST(Aggregate, RejectsOtherSettings) {
  auto records = summaries();
  const auto other = plan([](Json& manifest) { manifest["protocol"]["step_fraction"] = 0.125; });
  records.push_back(summary_of(test::made_up_outcome(other[3])));
  const auto said = refusal([&] { aggregate(records); });
  EXPECT_NE(said.find("/protocol/step_fraction: differs"), std::string::npos) << said;
}

TEST(Aggregate, RejectsOtherShearStrainsOnlyIfTheyWereMeasured) {
  const auto with = [](double until, bool measured) {
    const auto specs = plan([&](Json& manifest) {
      manifest["shear"] = {{"step", 0.01}, {"until", until}};
      if (measured) manifest["measure"].push_back("shear");
    });
    return summary_of(test::made_up_outcome(specs[3]));
  };
  const auto said = refusal([&] { aggregate(std::vector{with(0.1, true), with(0.2, true)}); });
  EXPECT_NE(said.find("/shear/until: differs"), std::string::npos) << said;
  auto another = with(0.2, false);
  ++another.replicate;
  EXPECT_NO_THROW(aggregate(std::vector{with(0.1, false), another}));
}

TEST(Aggregate, RejectsTwoResultsOfOneReplicate) {
  auto records = summaries();
  auto outcome = test::made_up_outcome(plan()[2]);
  outcome.timing.wall_seconds += 1;
  records.push_back(summary_of(outcome));
  EXPECT_EQ(refusal([&] { aggregate(records); }), "") << "timing may differ";
  outcome.jam.phi_j->density += 1e-15;
  records.push_back(summary_of(outcome));
  const auto said = refusal([&] { aggregate(records); });
  EXPECT_NE(said.find("two records of this replicate have different results"), std::string::npos) << said;
}

}  // namespace
}  // namespace isojam
