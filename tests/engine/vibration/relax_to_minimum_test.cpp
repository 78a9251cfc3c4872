#include "engine/vibration/relax_to_minimum.hpp"

#include <gtest/gtest.h>

#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"
#include "tests/engine/vibration/saddle.hpp"

namespace isojam {
namespace {

TEST(RelaxToMinimum, LeavesASaddle) {
  const Packing start = lattice(SolidKind::octahedron, 4, 0.95, 0);
  MinimumSearchOptions none;
  none.minimise.residual = 1e-8;
  none.max_descents = 0;
  const MinimumSearchResult saddle = relax_to_minimum(start, none);
  ASSERT_EQ(saddle.ended, MinimumSearchEnd::still_unstable) << to_string(saddle.ended);
  EXPECT_EQ(saddle.descents, 0);
  EXPECT_GT(saddle.stability.negative, 0);
  EXPECT_TRUE(is_equilibrium(saddle.summary));
  EXPECT_LE(balance_of(saddle.packing).residual, 1e-6) << "a saddle is in balance";

  MinimumSearchOptions options;
  options.minimise.residual = 1e-8;
  const MinimumSearchResult found = relax_to_minimum(saddle.packing, options);
  std::printf("%d negative modes, E/N %.3e; after %d descents %d, E/N %.3e\n", saddle.stability.negative,
              saddle.summary.energy / start.size(), found.descents, found.stability.negative,
              found.summary.energy / start.size());
  ASSERT_EQ(found.ended, MinimumSearchEnd::reached_minimum) << to_string(found.ended);
  EXPECT_GE(found.descents, 1);
  EXPECT_EQ(found.stability.negative, 0);
  EXPECT_NE(found.stability.verdict, Verdict::unstable);
  EXPECT_LE(balance_of(found.packing).residual, 1e-6);
  EXPECT_LT(found.summary.energy, saddle.summary.energy);
  EXPECT_TRUE(same_bits(found.packing, relax_to_minimum(saddle.packing, options).packing));
}

TEST(RelaxToMinimum, ReportsThatBalanceWasLost) {
  const MinimumSearchResult apart = relax_to_minimum(small_packing(SolidKind::octahedron, 0.2, 111));
  EXPECT_EQ(apart.ended, MinimumSearchEnd::lost_balance) << to_string(apart.ended);
  EXPECT_EQ(apart.summary.reason, StopReason::unjammed);
  EXPECT_EQ(apart.stability.verdict, Verdict::not_called);
  std::stop_source source;
  source.request_stop();
  const MinimumSearchResult stopped =
      relax_to_minimum(small_packing(SolidKind::octahedron, 0.7, 111), {}, source.get_token());
  EXPECT_EQ(stopped.ended, MinimumSearchEnd::lost_balance);
  EXPECT_EQ(stopped.summary.reason, StopReason::interrupted);
}

}  // namespace
}  // namespace isojam
