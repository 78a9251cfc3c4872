// Properties tested here:
// - Octahedra on a cubic lattice with equal orientations are in equilibrium by symmetry, at a saddle with many negative
//   modes. The descent finds a minimum of lower energy without negative modes, and the same start gives the same bits.
// - A minimum is unchanged, bit for bit.
// - With max_descents = 0 the saddle is reported as one. A packing that unjams, or a run that is interrupted, ends with
//   lost_balance.

#include "engine/vibration/follow_downhill.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"
#include "tests/engine/vibration/saddle.hpp"

namespace isojam {
namespace {

TEST(FollowDownhill, LeavesASaddle) {
  const Packing start = lattice(SolidKind::octahedron, 4, 0.95, 0);
  DownhillOptions none;
  none.minimise.residual = 1e-8;
  none.max_descents = 0;
  const DownhillResult saddle = follow_downhill(start, none);
  ASSERT_EQ(saddle.ended, DownhillEnd::still_unstable) << to_string(saddle.ended);
  EXPECT_EQ(saddle.descents, 0);
  EXPECT_GT(saddle.stability.negative, 0);
  EXPECT_TRUE(is_equilibrium(saddle.summary));
  EXPECT_LE(balance_of(saddle.packing).residual, 1e-6) << "a saddle is in balance";

  DownhillOptions options;
  options.minimise.residual = 1e-8;
  const DownhillResult found = follow_downhill(saddle.packing, options);
  std::printf("%d negative modes, E/N %.3e; after %d descents %d, E/N %.3e\n", saddle.stability.negative,
              saddle.summary.energy / start.size(), found.descents, found.stability.negative,
              found.summary.energy / start.size());
  ASSERT_EQ(found.ended, DownhillEnd::reached_minimum) << to_string(found.ended);
  EXPECT_GE(found.descents, 1);
  EXPECT_EQ(found.stability.negative, 0);
  EXPECT_NE(found.stability.verdict, Verdict::unstable);
  EXPECT_LE(balance_of(found.packing).residual, 1e-6);
  EXPECT_LT(found.summary.energy, saddle.summary.energy);
  EXPECT_TRUE(same_bits(found.packing, follow_downhill(saddle.packing, options).packing));
}

TEST(FollowDownhill, LeavesAMinimumAlone) {
  const Packing& minimum = nearest_state(jammed(SolidKind::octahedron, 48, .01));
  const DownhillResult result = follow_downhill(minimum);
  EXPECT_EQ(result.ended, DownhillEnd::was_minimum) << to_string(result.ended);
  EXPECT_EQ(result.descents, 0);
  EXPECT_EQ(result.stability.verdict, Verdict::stable);
  EXPECT_TRUE(same_bits(result.packing, minimum));
}

TEST(FollowDownhill, SaysThatBalanceWasLost) {
  const DownhillResult apart = follow_downhill(small_packing(SolidKind::octahedron, 0.2, 111));
  EXPECT_EQ(apart.ended, DownhillEnd::lost_balance) << to_string(apart.ended);
  EXPECT_EQ(apart.summary.reason, StopReason::unjammed);
  EXPECT_EQ(apart.stability.verdict, Verdict::not_called);
  std::stop_source source;
  source.request_stop();
  const DownhillResult stopped =
      follow_downhill(small_packing(SolidKind::octahedron, 0.7, 111), {}, source.get_token());
  EXPECT_EQ(stopped.ended, DownhillEnd::lost_balance);
  EXPECT_EQ(stopped.summary.reason, StopReason::interrupted);
}

TEST(FollowDownhill, NamesAreDistinct) {
  std::set<std::string_view> names;
  for (int k = 0; k <= static_cast<int>(DownhillEnd::undetermined); ++k)
    names.insert(to_string(static_cast<DownhillEnd>(k)));
  EXPECT_EQ(names.size(), 6U);
}

}  // namespace
}  // namespace isojam
