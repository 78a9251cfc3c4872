#include "engine/vibration/mode_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/engine/solve/solve_support.hpp"

namespace isojam {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(ModeStatistics, ParticipationCountsParticles) {
  RandomStream random{71};
  for (const int n : {1, 7, 30}) {
    for (int moving = 1; moving <= n; ++moving) {
      VectorXd mode = VectorXd::Zero(6 * n);
      const double scale = decade(random, -3, 3);
      for (int i = 0; i < moving; ++i)
        mode.segment<6>(6 * i) = scale * normal_vector(6, random).normalized();  // in a random direction
      EXPECT_NEAR(participation_ratio(mode), moving / static_cast<double>(n), 64 * eps) << n << " particles";
    }
  }
}

ModeSet all_modes(SolidKind kind, std::uint64_t seed) {
  return dense_modes(PackingEnergy().hessian(small_packing(kind, 0.7, seed)));
}

TEST(ModeStatistics, MeanFrequency) {
  ModeSet modes;
  modes.eigenvalues = (VectorXd(3) << 1, 4, 9).finished();
  EXPECT_EQ(mean_frequency(modes, 0.5), 2.0);
  EXPECT_EQ(mean_frequency(modes, 1), std::nullopt) << "a zero mode has no frequency";
  modes.eigenvalues[0] = -1;
  EXPECT_EQ(mean_frequency(modes, 0.5), std::nullopt);
  EXPECT_EQ(mean_frequency(ModeSet{}, 0), std::nullopt);
}

TEST(ModeStatistics, SharesOfAmplitude) {
  RandomStream random{72};
  const ModeSet all = all_modes(SolidKind::octahedron, 72);
  const auto n = static_cast<std::size_t>(all.vectors.rows() / 6);
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<char> marked(n), others(n);
    for (std::size_t i = 0; i < n; ++i) others[i] = !(marked[i] = random.uniform() < 0.4);
    const auto here = amplitude_share(all, marked), there = amplitude_share(all, others);
    ASSERT_TRUE(here && there);
    EXPECT_NEAR(here->amplitude + there->amplitude, 1, 1e3 * eps);
    EXPECT_EQ(here->particles + there->particles, 1);
    // All modes and the translations form a basis, in which each particle has six dimensions.
    EXPECT_NEAR(here->amplitude, here->particles, 3.0 / static_cast<double>(all.size()));
  }
  EXPECT_FALSE(amplitude_share(ModeSet{}, std::vector<char>(n)));
}

TEST(ModeStatistics, ShareOfOneParticle) {
  ModeSet modes;
  modes.eigenvalues = VectorXd::Ones(2);
  modes.vectors = Eigen::MatrixXd::Zero(18, 2);
  modes.vectors(3, 0) = modes.vectors(12, 1) = 1;
  const auto share = amplitude_share(modes, std::vector<char>{1, 0, 0});
  ASSERT_TRUE(share);
  EXPECT_EQ(share->amplitude, 0.5);
  EXPECT_EQ(share->particles, 1.0 / 3);
}

TEST(ModeStatistics, DensityOfStatesIntegratesToOne) {
  for (const SolidKind kind : all_solids) {
    const ModeSet all = all_modes(kind, 73);
    const auto with = static_cast<double>((all.eigenvalues.array() > 0).count());
    const auto states = density_of_states(all.eigenvalues, 0, 17);
    ASSERT_TRUE(states);
    const VectorXd widths = states->edges.tail(17) - states->edges.head(17);
    const auto modes = static_cast<double>(all.size());
    EXPECT_NEAR(states->density.dot(widths), with / modes, 64 * eps);
    EXPECT_EQ(states->without_frequency, all.size() - static_cast<Index>(with));
    EXPECT_EQ(states->cumulative[17], 1);
    for (int k = 1; k < 17; ++k) {
      const double square = std::pow(10, 2 * states->edges[k]);
      const auto below = static_cast<double>((all.eigenvalues.array() < square).count());
      EXPECT_NEAR(states->cumulative[k], below / modes, 1 / modes) << "edge " << k;
    }
  }
}

TEST(ModeStatistics, DensityOfStatesNeedsTwoFrequencies) {
  EXPECT_FALSE(density_of_states(VectorXd(), 0));
  EXPECT_FALSE(density_of_states(VectorXd::Ones(5), 0));
  EXPECT_FALSE(density_of_states(VectorXd::LinSpaced(5, 1, 2), 3));
  EXPECT_FALSE(density_of_states(VectorXd::LinSpaced(5, 1, 2), 0, 0));
  EXPECT_TRUE(density_of_states(VectorXd::LinSpaced(5, 1, 2), 0, 1));
}

}  // namespace
}  // namespace isojam
