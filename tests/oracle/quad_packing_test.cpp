// Tests the evaluation in quadruple precision, which is the reference for the engine.

#include "tests/oracle/quad_packing.hpp"

#include <gtest/gtest.h>

#include "engine/packing/energy.hpp"
#include "engine/random/stream.hpp"

namespace isojam::oracle {
namespace {

using Eigen::VectorXd;

constexpr int particles = 90;

Packing random_sample(SolidKind kind) {
  RandomStream random{63, static_cast<std::uint64_t>(kind)};
  return random_packing(platonic(kind), particles, .4, random);
}

VectorXd random_direction(RandomStream& random) {
  VectorXd direction(6 * particles);
  for (double& x : direction) x = random.normal();
  return direction.normalized();
}

class QuadPacking : public testing::TestWithParam<SolidKind> {};

INSTANTIATE_TEST_SUITE_P(Solids, QuadPacking, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

TEST_P(QuadPacking, ForcesAreTheSlopesOfTheEnergy) {
  const Packing packing = random_sample(GetParam());
  const std::vector<Quad> gradient = gradient_of(evaluate_in_quad(packing), packing);
  RandomStream random{63, 2};
  for (int k = 0; k < 3; ++k) {
    const VectorXd direction = random_direction(random);
    // The truncation error is proportional to h², the rounding error to 1e-33/h.
    const double h = 1e-10;
    const Quad rise = evaluate_in_quad(moved(packing, h * direction)).energy -
                      evaluate_in_quad(moved(packing, -h * direction)).energy;
    Quad slope = 0, scale = 0;
    for (int i = 0; i < 6 * particles; ++i) slope += gradient[i] * direction[i], scale += gradient[i] * gradient[i];
    EXPECT_NEAR(static_cast<double>(rise / (2 * Quad(h))), static_cast<double>(slope),
                1e-12 * static_cast<double>(square_root(scale)));
  }
}

TEST_P(QuadPacking, ForcesBalanceInSum) {
  const QuadEvaluation evaluation = evaluate_in_quad(random_sample(GetParam()));
  Quad3 sum{};
  for (const Quad3& force : evaluation.force) sum = sum + force;
  EXPECT_GT(evaluation.contacts, particles);
  EXPECT_LE(static_cast<double>(norm(sum) / evaluation.mean_force), 1e-31);
}

TEST_P(QuadPacking, AgreesWithDoublesWhereTheySuffice) {
  const Packing packing = random_sample(GetParam());
  const Evaluation working = PackingEnergy().evaluate(packing);
  const QuadEvaluation exact = evaluate_in_quad(packing);
  const std::vector<Quad> gradient = gradient_of(exact, packing);
  EXPECT_EQ(working.contacts, exact.contacts);
  EXPECT_NEAR(working.energy, static_cast<double>(exact.energy), 1e-12 * working.energy);
  EXPECT_NEAR(working.residual, static_cast<double>(exact.residual), 1e-11 * working.residual);
  EXPECT_NEAR(working.mean_force, static_cast<double>(exact.mean_force), 1e-12 * working.mean_force);
  for (int i = 0; i < 6 * particles; ++i)
    EXPECT_NEAR(working.gradient[i], static_cast<double>(gradient[i]), 1e-12 * working.gradient.norm()) << i;
}

TEST(QuadPackingTest, WithoutContactsAllIsZero) {
  Packing packing = random_sample(SolidKind::octahedron);
  packing.poses.resize(1);
  const QuadEvaluation alone = evaluate_in_quad(packing);
  EXPECT_EQ(alone.contacts, 0);
  EXPECT_TRUE(alone.energy == 0 && alone.residual == 0 && alone.mean_force == 0);
}

}  // namespace
}  // namespace isojam::oracle
