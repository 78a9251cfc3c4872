#include "tests/bench/ratios.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/random/stream.hpp"

namespace isojam::bench {
namespace {

using Kind = Claim::Kind;

TEST(RatiosTest, MedianIsTheMiddle) {
  RandomStream random{61};
  for (std::size_t n = 1; n < 20; ++n) {
    std::vector<double> values(n);
    for (double& value : values) value = random.normal();
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(median(values), (sorted[(n - 1) / 2] + sorted[n / 2]) / 2) << n << " values";
  }
}

TEST(RatiosTest, ClaimsHoldOnOneSideOfTheirBound) {
  const std::map<std::string, double> medians{{"f/ours/x", 200}, {"f/peer/x", 1000}, {"f/peer/x#bytes", 3}};
  const auto verdict = [&](const Claim& claim) { return judge({claim}, medians).at(0); };
  EXPECT_EQ(verdict({Kind::faster, "f/ours/x", "f/peer/x", 0}).ratio, 5);
  EXPECT_EQ(verdict({Kind::costs, "f/ours/x", "f/peer/x", 0}).ratio, 0.2);
  EXPECT_EQ(verdict({Kind::absolute, "f/ours/x", "", 0}).ratio, 200);
  EXPECT_EQ(verdict({Kind::faster, "f/ours/x", "f/peer/x", 0, 10, 1}).ratio, 50);
  EXPECT_EQ(verdict({Kind::costs, "f/ours/x", "f/peer/x", 0, 1, 10}).ratio, 2);
  EXPECT_TRUE(verdict({Kind::faster, "f/ours/x", "f/peer/x", 5}).holds);
  EXPECT_FALSE(verdict({Kind::faster, "f/ours/x", "f/peer/x", 5.1}).holds);
  EXPECT_TRUE(verdict({Kind::costs, "f/ours/x", "f/peer/x", 0.2}).holds);
  EXPECT_FALSE(verdict({Kind::costs, "f/ours/x", "f/peer/x", 0.19}).holds);
  EXPECT_TRUE(verdict({Kind::absolute, "f/ours/x", "", 200}).holds);
  EXPECT_FALSE(verdict({Kind::absolute, "f/ours/x", "", 199}).holds);
  for (const Kind kind : {Kind::faster, Kind::costs, Kind::absolute})
    EXPECT_TRUE(verdict({kind, "f/ours/x", "f/peer/x", 0}).holds);
}

TEST(RatiosTest, ClaimsWithoutMeasurementsAreIgnored) {
  const std::vector<Claim> claims{{Kind::faster, "f/ours/x", "f/peer/x", 5},
                                  {Kind::faster, "f/peer/x", "f/ours/x", 5},
                                  {Kind::absolute, "f/other/x", "", 5},
                                  {Kind::absolute, "f/ours/x", "", 5}};
  const std::vector<Verdict> verdicts = judge(claims, {{"f/ours/x", 1}});
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].claim.kind, Kind::absolute);
}

TEST(RatiosTest, ClaimsNameTwoQuantitiesOfOneFamily) {
  const auto slashes = [](const std::string& name) { return std::count(name.begin(), name.end(), '/'); };
  const auto family = [](const std::string& name) { return name.substr(0, name.find('/')); };
  for (const Claim& claim : all_claims()) {
    EXPECT_EQ(slashes(claim.ours), 2) << claim.ours;
    EXPECT_EQ(claim.peer.empty(), claim.kind == Kind::absolute) << claim.ours;
    if (claim.peer.empty()) continue;
    EXPECT_EQ(slashes(claim.peer), 2) << claim.peer;
    EXPECT_NE(claim.ours, claim.peer);
    EXPECT_EQ(family(claim.ours), family(claim.peer));
  }
}

}  // namespace
}  // namespace isojam::bench
