// Facts proved here:
//   floppy motions leave every contact's volume to first order and every translation alone, are as many as the rank of
//   the normals says, move some particle by 1 and none by more, and diagonalise the Hessian, of which the second term
//   alone opposes them;
//   the energy along them rises as ½ uᵀHu a² at small amplitudes, is that of packings evaluated anew, and does not rise
//   without a motion.

#include "engine/rigidity/floppy_motions.hpp"

#include <gtest/gtest.h>

#include "engine/rigidity/pair_stiffness.hpp"
#include "engine/rigidity/rigidity.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Floppy {
  explicit Floppy(const Packing& state) : packing(state) {
    PackingEnergy energy;
    contacts = energy.contacts(packing);
    normals = normal_constraints(packing, contacts);
    const auto blocks = energy.hessian(packing, Precision::double_double);
    hessian = dense_matrix(blocks);
    motions = floppy_motions(normals, blocks);
  }
  const Packing& packing;
  std::vector<Contact> contacts;
  RigidityMatrix normals;
  MatrixXd hessian;
  FloppyMotions motions;
};

std::vector<const Packing*> states_to_try() {
  return {
      &jammed(SolidKind::octahedron, 48, .01).states.front(), &nearest_state(jammed(SolidKind::octahedron, 48, .01)),
      &nearest_state(jammed(SolidKind::tetrahedron, 64, .02)), &nearest_state(jammed(SolidKind::icosahedron, 32, .01))};
}

TEST(FloppyMotionsTest, AreWhatNormalsLeave) {
  for (const Packing* state : states_to_try()) {
    const Floppy floppy(*state);
    const MatrixXd& u = floppy.motions.vectors;
    const int expected = analyse_rigidity(floppy.normals).floppy - 3;
    ASSERT_EQ(u.cols(), expected);
    ASSERT_GT(expected, 0);
    EXPECT_LE((floppy.normals.rows * u).cwiseAbs().maxCoeff(), 1e-9);
    const MatrixXd among = u.transpose() * floppy.hessian * u;
    const double scale = floppy.hessian.cwiseAbs().maxCoeff() * 1e-13 * static_cast<double>(u.rows());
    const auto pairs = pair_stiffnesses(*state, floppy.contacts);
    for (Eigen::Index k = 0; k < u.cols(); ++k) {
      double largest = 0;
      for (int i = 0; i < state->size(); ++i) largest = std::max(largest, u.col(k).segment<6>(6 * i).norm());
      EXPECT_NEAR(largest, 1, 1e-14);
      for (int c = 0; c < 3; ++c) {
        double shift = 0;
        for (int i = 0; i < state->size(); ++i) shift += u(6 * i + c, k);
        EXPECT_LE(std::abs(shift), 1e-9);
      }
      EXPECT_NEAR(among(k, k), floppy.motions.stiffness[k] * u.col(k).squaredNorm(), scale);
      const auto shares = stiffness_shares(floppy.contacts, pairs, 10, u.col(k));
      EXPECT_LE(shares.normal, scale) << "motion " << k;
    }
    EXPECT_LE((among - MatrixXd(among.diagonal().asDiagonal())).cwiseAbs().maxCoeff(), scale);
  }
}

TEST(FloppyMotionsTest, EnergyRises) {
  for (const Packing* state : states_to_try()) {
    const Floppy floppy(*state);
    const Eigen::Index count = floppy.motions.vectors.cols();
    MatrixXd some(floppy.motions.vectors.rows(), 4);
    some << floppy.motions.vectors.col(0), floppy.motions.vectors.col(count / 2), floppy.motions.vectors.col(count - 1),
        VectorXd::Zero(floppy.motions.vectors.rows());
    const std::vector<double> amplitudes{1e-9, 3e-3};
    const auto along = energy_along(*state, some, amplitudes);
    const double at_rest = PackingEnergy().evaluate(*state, Precision::double_double).energy;
    EXPECT_GT(along.noise, 0);
    EXPECT_LE(along.noise, 1e-9 * at_rest);
    for (Eigen::Index k = 0; k < 4; ++k) {
      double sum = 0;
      for (const double a : {amplitudes[1], -amplitudes[1]})
        sum += PackingEnergy().evaluate(moved(*state, a * some.col(k)), Precision::double_double).energy;
      EXPECT_NEAR(along.rise(k, 1), sum / 2 - at_rest, along.noise);
      if (k == 3) {
        EXPECT_EQ(along.rise(k, 1), 0);
      }
    }
    // The stiffest of these, at a depth that no flat contact has: quadratic.
    const double curvature = some.col(2).dot(floppy.hessian * some.col(2));
    const std::vector<double> ladder{1e-6, 2e-6};
    const auto steep = energy_along(*state, some.col(2), ladder);
    if (steep.rise(0, 0) > 1e3 * steep.noise) {
      EXPECT_NEAR(steep.rise(0, 0) / (curvature * ladder[0] * ladder[0] / 2), 1, .1) << curvature;
    }
  }
}

}  // namespace
}  // namespace isojam
