#include "engine/solve/rearrangement.hpp"

#include <gtest/gtest.h>

namespace isojam {
namespace {

JamStep followed(double energy_ratio, int lost = 0, int gained = 0, double moved = 0) {
  JamStep step;
  step.stage = JamStage::decompression;
  step.rearrangement = Rearrangement{energy_ratio, lost, gained, moved};
  return step;
}

JamStep without_state(JamStage stage, bool lost = false) {
  JamStep step;
  step.stage = stage;
  step.lost = lost;
  return step;
}

TEST(GaveWay, BelowHalfOfTheExpectedEnergy) {
  EXPECT_TRUE(is_rearranged(followed(0.499)));
  EXPECT_TRUE(is_rearranged(followed(0)));
  EXPECT_TRUE(is_rearranged(followed(-1e-9))) << "an energy lost to rounding";
  EXPECT_FALSE(is_rearranged(followed(0.5)));
  EXPECT_FALSE(is_rearranged(followed(1)));
  EXPECT_FALSE(is_rearranged(followed(3))) << "a jump to a stiffer branch loses nothing";
  EXPECT_TRUE(is_rearranged(without_state(JamStage::decompression, true)));
  EXPECT_FALSE(is_rearranged(without_state(JamStage::decompression)));
  EXPECT_FALSE(is_rearranged(without_state(JamStage::compression)));
}

TEST(Rearrangements, AreCountedInStepsBetweenEquilibria) {
  const std::vector<JamStep> path{without_state(JamStage::compression),
                                  without_state(JamStage::compression),
                                  without_state(JamStage::decompression),  // the first state
                                  followed(0.9, 40, 2, 30),
                                  followed(0.3, 7, 3, 4.5),
                                  without_state(JamStage::decompression),  // failed
                                  followed(0.7, 11, 1, 20),
                                  without_state(JamStage::decompression, true),
                                  without_state(JamStage::decompression),  // recompression
                                  without_state(JamStage::decompression),
                                  followed(0.1, 2, 0, 1.5)};
  const auto found = rearrangements(path);
  EXPECT_EQ(found.steps, 5);
  EXPECT_EQ(found.count, 3);
  EXPECT_EQ(found.particles_moved, 3);
  EXPECT_EQ(found.contacts_lost, 4.5);
  EXPECT_EQ(found.contacts_gained, 1.5);
}

TEST(Rearrangements, HaveNoMeansIfThereAreNone) {
  for (const auto& path :
       {std::vector<JamStep>{}, {followed(0.9, 5, 1, 3)}, {without_state(JamStage::decompression, true)}}) {
    const auto found = rearrangements(path);
    EXPECT_EQ(found.steps, static_cast<int>(path.size()));
    EXPECT_EQ(found.count, !path.empty() && path[0].lost ? 1 : 0);
    EXPECT_FALSE(found.particles_moved);
    EXPECT_FALSE(found.contacts_lost);
    EXPECT_FALSE(found.contacts_gained);
  }
}

}  // namespace
}  // namespace isojam
