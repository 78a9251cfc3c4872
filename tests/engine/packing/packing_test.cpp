#include "engine/packing/packing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "engine/packing/energy.hpp"
#include "tests/engine/packing/packings.hpp"

namespace isojam {
namespace {

using namespace testing_packings;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(RandomPackingTest, HasItsDensityAndIsAFunctionOfItsStream) {
  for (const SolidKind kind : all_solids) {
    const Packing one = sample(kind, 150, .7, 1), same = sample(kind, 150, .7, 1), other = sample(kind, 150, .7, 2);
    EXPECT_EQ(one.size(), 150);
    EXPECT_NEAR(one.density(), .7, 8 * epsilon);
    for (int i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one.poses[i].position, same.poses[i].position) << "particle " << i;
      EXPECT_EQ(one.poses[i].orientation.coeffs(), same.poses[i].orientation.coeffs()) << "particle " << i;
      EXPECT_NE(one.poses[i].position, other.poses[i].position) << "particle " << i;
      EXPECT_NEAR(one.poses[i].orientation.norm(), 1, 2 * epsilon) << "particle " << i;
    }
  }
}

TEST(RandomPackingTest, FillsTheCellAndTheRotationsEvenly) {
  const int n = 20000;
  const Packing packing = sample(SolidKind::cube, n, .5, 3);
  const double side = packing.cell.side();
  Vector3d mean = Vector3d::Zero(), square = Vector3d::Zero();
  Matrix3d rotation = Matrix3d::Zero(), squares = Matrix3d::Zero();
  for (const Pose& pose : packing.poses) {
    const Vector3d u = pose.position / side;
    ASSERT_TRUE((u.array() >= 0).all() && (u.array() < 1 + epsilon).all()) << u.transpose();
    mean += u / n;
    square += u.cwiseAbs2() / n;
    const Matrix3d r = pose.orientation.toRotationMatrix();
    rotation += r / n;
    squares += r.cwiseAbs2() / n;
  }
  // Five standard errors. The entries x of a uniform random rotation have mean 0 and variance 1/3, and ⟨x⁴⟩ − ⟨x²⟩² =
  // 1/5 − 1/9.
  const double error = 5 / std::sqrt(n);
  EXPECT_LE((mean.array() - .5).abs().maxCoeff(), error * std::sqrt(1.0 / 12)) << mean.transpose();
  EXPECT_LE((square.array() - 1.0 / 3).abs().maxCoeff(), error * std::sqrt(1.0 / 5 - 1.0 / 9)) << square.transpose();
  EXPECT_LE(rotation.cwiseAbs().maxCoeff(), error * std::sqrt(1.0 / 3)) << rotation;
  EXPECT_LE((squares.array() - 1.0 / 3).abs().maxCoeff(), error * std::sqrt(1.0 / 5 - 1.0 / 9)) << squares;
}

TEST(RandomPackingTest, RejectsACellTooSmall) {
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    RandomStream random{7, 2};
    for (const double density : {.05, .7, 1.0}) {
      const int least = least_particles(solid, density);
      EXPECT_THROW(random_packing(solid, least - 1, density, random), std::invalid_argument) << to_string(kind);
      EXPECT_EQ(random_packing(solid, least, density, random).size(), least) << to_string(kind);
    }
  }
}

TEST(PackingEnergyTest, RejectsACellTooSmall) {
  for (Packing& packing : samples(4, 80, .5)) {
    PackingEnergy energy;
    packing.cell = PeriodicCell(least_side(packing.solids.only()));
    EXPECT_THROW(energy.evaluate(packing), std::invalid_argument) << describe(packing);
    EXPECT_THROW(energy.second_order(packing, 0), std::invalid_argument) << describe(packing);
    packing.cell = PeriodicCell(least_side(packing.solids.only()) * (1 + epsilon));
    EXPECT_GT(energy.evaluate(packing).contacts, 0) << describe(packing);
  }
}

TEST(StrainedToTest, MovesCentresAffinely) {
  const Packing packing = sample(SolidKind::icosahedron, 100, .3, 5);
  const Packing strained = strained_to(packing, .8);
  EXPECT_NEAR(strained.density(), .8, 16 * epsilon);
  for (int i = 0; i < packing.size(); ++i) {
    const Vector3d before = packing.poses[i].position / packing.cell.side();
    EXPECT_LE((strained.poses[i].position / strained.cell.side() - before).norm(), 8 * epsilon) << "particle " << i;
    EXPECT_EQ(strained.poses[i].orientation.coeffs(), packing.poses[i].orientation.coeffs()) << "particle " << i;
  }
}

TEST(MovedTest, AddsTheStepAndRotates) {
  RandomStream random{7, 3};
  const Packing packing = sample(SolidKind::tetrahedron, 80, .5, 6);
  const Eigen::VectorXd step = random_step(random, packing.size());
  const Packing result = moved(packing, step);
  EXPECT_EQ(result.cell.side(), packing.cell.side());
  for (int i = 0; i < packing.size(); ++i) {
    EXPECT_EQ(result.poses[i].position, packing.poses[i].position + step.segment<3>(6 * i)) << "particle " << i;
    const Vector3d theta = step.segment<3>(6 * i + 3) / packing.solids.only().gyration_radius();
    const Matrix3d turned =
        Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix() * packing.poses[i].orientation;
    EXPECT_LE((result.poses[i].orientation.toRotationMatrix() - turned).norm(), 32 * epsilon * (1 + theta.norm()))
        << "particle " << i;
  }
}

TEST(MovedTest, KeepsLowParts) {
  RandomStream random{7, 4};
  const Packing packing = sample(SolidKind::cube, 80, .5, 7);
  const Eigen::VectorXd step = random_step(random, packing.size());
  const Packing there = moved(packing, 1e-25 * step), back = moved(there, -1e-25 * step);
  const Packing strained = strained_to(strained_to(there, .7), .5);
  for (int i = 0; i < packing.size(); ++i) {
    const Quad3 start = quad_position(packing.poses[i]), moved_to = quad_position(there.poses[i]);
    const Vector3d went = rounded(moved_to - start), stayed = rounded(quad_position(back.poses[i]) - start);
    EXPECT_LE((went - 1e-25 * step.segment<3>(6 * i)).norm(), 1e-30) << "particle " << i;
    EXPECT_LE(stayed.norm(), 1e-30) << "particle " << i;
    const double cells = there.cell.side() / strained.cell.side();
    EXPECT_LE(rounded(Quad(cells) * quad_position(strained.poses[i]) - moved_to).norm(), 1e-30) << "particle " << i;
    EXPECT_NE(there.poses[i].orientation_low, packing.poses[i].orientation_low) << "particle " << i;
  }
}

}  // namespace
}  // namespace isojam
