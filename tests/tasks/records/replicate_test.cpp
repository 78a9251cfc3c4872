// Properties tested here with real packings of 24 dodecahedra:
// - If a run stops at max_density or max_steps, the message names the key of the manifest that sets the limit.
// - If φ_J was fitted to states outside the fit window, the replicate is flagged; otherwise it is not.
// - Exactly these settings cause a warning before the run.

#include "tasks/records/replicate.hpp"

#include <gtest/gtest.h>

#include "tasks/manifest/warnings.hpp"
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
  expect_failure(try_with({{"max_density", 0.66}}), "density_limit", "/protocol/max_density");
  expect_failure(try_with({{"max_steps", 5}}), "step_limit", "/protocol/max_steps");
}

TEST(Replicate, StatesOutsideTheFitWindowAreFlagged) {
  const auto outside = try_with({{"fit_window", 0.02}});
  ASSERT_FALSE(outside.outcome.failure) << outside.outcome.failure->why;
  EXPECT_EQ(flags_of(outside.outcome), std::vector<std::string>{"outside_fit_window"});
  ASSERT_EQ(outside.warnings.size(), 1U);
  EXPECT_EQ(outside.warnings.front().rfind("/protocol/final_distance: ", 0), 0U) << outside.warnings.front();

  const auto inside = try_with(Json::object());
  ASSERT_FALSE(inside.outcome.failure) << inside.outcome.failure->why;
  EXPECT_EQ(flags_of(inside.outcome), std::vector<std::string>{});
  EXPECT_EQ(inside.warnings, std::vector<std::string>{});
}

}  // namespace
}  // namespace isojam
