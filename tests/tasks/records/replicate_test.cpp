#include "tasks/records/replicate.hpp"

#include <gtest/gtest.h>

#include "tasks/manifest/warnings.hpp"
#include "tasks/records/failure_text.hpp"
#include "tasks/records/record.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

struct Tried {
  std::vector<std::string> warnings;
  Outcome outcome;
};

Tried try_with(const Json& protocol) {
  auto json = test::tiny_manifest();
  json["protocol"].update(protocol);
  json["measure"] = Json::array();
  const auto manifest = parse_manifest(json.dump(), "m.json");
  Tried tried{warnings_of(manifest), {}};
  tried.outcome.spec = Plan(manifest).at(0, 0);
  const auto stages = engine_stages();
  tried.outcome.jam = stages.jam(tried.outcome.spec, stages.begin(tried.outcome.spec).progress, {}, {});
  tried.outcome.failure = failure_of(tried.outcome.jam);
  return tried;
}

void expect_failure(const Tried& tried, const std::string& status, const std::string& key) {
  ASSERT_TRUE(tried.outcome.failure);
  const auto& why = tried.outcome.failure->why;
  EXPECT_EQ(why.rfind(status + " after ", 0), 0U) << why;
  EXPECT_NE(why.find(key), std::string::npos) << why;
  ASSERT_EQ(tried.warnings.size(), 1U);
  EXPECT_EQ(tried.warnings.front().rfind(key + ": ", 0), 0U) << tried.warnings.front();
}

TEST(Replicate, ALimitThatStopsARunIsNamed) {
  const auto by_density = try_with({{"max_density", 0.66}}), by_steps = try_with({{"max_steps", 5}});
  expect_failure(by_density, "density_limit", "/protocol/max_density");
  expect_failure(by_steps, "step_limit", "/protocol/max_steps");
  const auto text = failure_text(make_record(by_density.outcome));
  EXPECT_TRUE(text.starts_with("max_density was reached before the end of compression (")) << text;
  EXPECT_TRUE(text.ends_with("); increase max_density")) << text;
  const auto steps = failure_text(make_record(by_steps.outcome));
  EXPECT_TRUE(steps.starts_with("max_steps was reached before the end of compression (5 steps, density ")) << steps;
  EXPECT_TRUE(steps.ends_with("); increase max_steps")) << steps;
}

TEST(Replicate, MessagesOfOtherFailuresStateTheRemedyForTheLastStep) {
  auto outcome = test::made_up_outcome(Plan(parse_manifest(test::tiny_manifest().dump(), "m.json")).at(0, 0));
  outcome.jam.status = JamStatus::not_jammed;
  auto& path = outcome.jam.path;
  path.front().stage = JamStage::compression;
  const auto text_of = [&] {
    outcome.failure = failure_of(outcome.jam);
    return failure_text(make_record(outcome));
  };
  for (const auto& [reason, remedy] : {std::pair{StopReason::budget, "; increase max_evaluations"},
                                       {StopReason::unjammed, "; increase target_energy"},
                                       {StopReason::residual_reached,
                                        "; decrease final_distance, or increase "
                                        "target_energy"},
                                       {StopReason::not_finite, ""}}) {
    path.back().summary.reason = reason;
    const auto text = text_of();
    EXPECT_TRUE(text.starts_with("decompression found fewer than two states (4 steps, density ")) << text;
    EXPECT_TRUE(text.ends_with(std::string(")") + remedy)) << text;
  }
  path.back().summary.reason = StopReason::unjammed;
  path.front().stage = JamStage::decompression;
  EXPECT_TRUE(text_of().ends_with("; use a denser initial packing")) << text_of();
  path.front().lost = true;
  EXPECT_TRUE(text_of().ends_with(")")) << text_of();
  outcome.failure = Failure{"modes", "no reason"};
  EXPECT_EQ(failure_text(make_record(outcome)), "no reason (measure modes)");
  outcome.failure = Failure{"jam", "the cell is so small that a particle can touch two images of another"};
  EXPECT_EQ(failure_text(make_record(outcome)), outcome.failure->why + "; use more particles");
}

TEST(Replicate, AMissingEquilibriumAtZeroPressureIsNamed) {
  auto json = test::tiny_manifest();
  json["sweep"]["particles"] = {32};
  json["protocol"]["cohesion"] = {{"strength", 1e-4}, {"until", "end"}};
  json["measure"] = {"contacts"};
  auto outcome = test::made_up_outcome(Plan(parse_manifest(json.dump(), "m.json")).at(0, 0));
  outcome.jam.status = JamStatus::not_jammed;
  outcome.jam.path.back().summary.reason = StopReason::budget;
  outcome.failure = failure_of(outcome.jam);
  const auto text = failure_text(make_record(outcome));
  EXPECT_TRUE(text.starts_with("no equilibrium at zero pressure was found (4 steps, density ")) << text;
  EXPECT_TRUE(text.ends_with("); increase max_evaluations")) << text;
}

TEST(Replicate, StatesOutsideTheFitWindowAreFlagged) {
  const auto outside = try_with({{"fit_window", 0.03}});
  ASSERT_FALSE(outside.outcome.failure) << outside.outcome.failure->why;
  EXPECT_EQ(flags_of(outside.outcome), std::vector<Flag>{Flag::outside_fit_window});
  ASSERT_EQ(outside.warnings.size(), 1U);
  EXPECT_EQ(outside.warnings.front().rfind("/protocol/final_distance: ", 0), 0U) << outside.warnings.front();

  const auto inside = try_with(Json::object());
  ASSERT_FALSE(inside.outcome.failure) << inside.outcome.failure->why;
  EXPECT_EQ(flags_of(inside.outcome), std::vector<Flag>{});
  EXPECT_EQ(inside.warnings, std::vector<std::string>{});
}

}  // namespace
}  // namespace isojam
