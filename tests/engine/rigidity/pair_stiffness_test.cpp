#include "engine/rigidity/pair_stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "engine/rigidity/rigidity.hpp"
#include "engine/solve/factor/dense.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Stiff {
  explicit Stiff(const Packing& state) : packing(state) {
    PackingEnergy energy;
    contacts = energy.contacts(packing);
    pairs = pair_stiffnesses(packing, contacts);
    hessian = dense_matrix(energy.hessian(packing, Precision::double_double));
    gradient = energy.evaluate(packing, Precision::double_double).gradient;
  }
  const Packing& packing;
  std::vector<Contact> contacts;
  std::vector<PairStiffness> pairs;
  MatrixXd hessian;
  VectorXd gradient;
};

std::vector<Packing> states_to_try() {
  std::vector<Packing> states;
  for (const auto& state : jammed(SolidKind::octahedron, 48, .01).states) states.push_back(state);
  states.push_back(nearest_state(jammed(SolidKind::tetrahedron, 64, .02)));
  states.push_back(nearest_state(jammed(SolidKind::icosahedron, 32, .01)));
  states.push_back(small_packing(SolidKind::dodecahedron, .7, 97));
  return states;
}

TEST(PairStiffnessTest, SumsToTheHessian) {
  for (const Packing& packing : states_to_try()) {
    const Stiff stiff(packing);
    MatrixXd sum = MatrixXd::Zero(stiff.hessian.rows(), stiff.hessian.cols());
    for (std::size_t c = 0; c < stiff.contacts.size(); ++c) {
      const PairStiffness& pair = stiff.pairs[c];
      const Matrix12d whole = pair.normal_stiffness * pair.normal * pair.normal.transpose() + pair.second;
      const std::array at{stiff.contacts[c].pair.a, stiff.contacts[c].pair.b};
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) sum.block<6, 6>(6 * at[i], 6 * at[j]) += whole.block<6, 6>(6 * i, 6 * j);
      }
      EXPECT_TRUE(pair.has_second);
    }
    const double off = (sum - stiff.hessian).cwiseAbs().maxCoeff() / stiff.hessian.cwiseAbs().maxCoeff();
    EXPECT_LE(off, 64 * eps) << "density " << packing.density();
  }
}

TEST(PairStiffnessTest, TiltsAreAllOtherRelativeMotions) {
  for (const Packing& packing : states_to_try()) {
    const Stiff stiff(packing);
    for (std::size_t c = 0; c < stiff.contacts.size(); ++c) {
      const PairStiffness& pair = stiff.pairs[c];
      const Eigen::Matrix<double, 5, 5> overlap = pair.tilts.transpose() * pair.tilts;
      EXPECT_LE((overlap - Eigen::Matrix<double, 5, 5>::Identity()).norm(), 100 * eps);
      EXPECT_LE((pair.normal.transpose() * pair.tilts).norm(), 100 * eps);
      EXPECT_NEAR(pair.normal.norm(), 1, 10 * eps);
      Eigen::Matrix<double, 5, 5> diagonal = pair.tilts.transpose() * pair.second * pair.tilts;
      diagonal.diagonal() -= pair.tilt_stiffness;
      EXPECT_LE(diagonal.norm(), 100 * eps * pair.second.norm());
      for (int k = 0; k < 4; ++k) EXPECT_GE(pair.tilt_stiffness[k], pair.tilt_stiffness[k + 1]);
      // A rotation of the pair as a whole about the centre of A.
      const double radius = packing.solids.only().gyration_radius();
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d turn = Vector3d::Unit(axis);
        Vector12d motion;
        motion << Vector3d::Zero(), radius * turn, turn.cross(stiff.contacts[c].displacement), radius * turn;
        EXPECT_LE((pair.tilts.transpose() * motion).norm(), 100 * eps * motion.norm());
      }
    }
  }
}

TEST(PairStiffnessTest, ContributionsSumToTheEnergy) {
  RandomStream random{98};
  for (const Packing& packing : states_to_try()) {
    const Stiff stiff(packing);
    for (const double threshold : {1.0, 10.0, 1e6}) {
      for (int k = 0; k < 3; ++k) {
        const VectorXd u = normal_vector(stiff.hessian.rows(), random);
        const auto shares = stiffness_shares(stiff.contacts, stiff.pairs, threshold, u);
        const double whole = u.dot(stiff.hessian * u);
        EXPECT_NEAR(shares.total() / whole, 1, 1e-11);
        EXPECT_GE(shares.normal, 0);
        EXPECT_GE(shares.tilt, 0);
      }
    }
  }
  const Packing& nearest = nearest_state(jammed(SolidKind::octahedron, 48, .01));
  const Stiff stiff(nearest);
  PackingEnergy energy;
  const auto modes = dense_modes(energy.hessian(nearest, Precision::double_double));
  const double rounding = 1e3 * eps * modes.eigenvalues.tail(1)[0];
  for (Eigen::Index k = 0; k < modes.size(); ++k) {
    const auto shares = stiffness_shares(stiff.contacts, stiff.pairs, 10, modes.vectors.col(k));
    EXPECT_NEAR(shares.total(), modes.eigenvalues[k], rounding) << "mode " << k;
  }
}

/// The stiffness of a constructed contact, where A has a random orientation.
PairStiffness stiffness_of(const ConvexSolid& solid, const Contact& touching, RandomStream& random) {
  Packing packing{solid, PeriodicCell(100), std::vector<Pose>(2)};
  const Eigen::Quaterniond q = constructed::random_orientation(random);
  packing.poses[0].orientation = q;
  packing.poses[1].position = q * touching.pose.displacement;
  packing.poses[1].orientation = q * Eigen::Quaterniond(touching.pose.rotation);
  PackingEnergy energy;
  const auto contacts = energy.contacts(packing);
  EXPECT_EQ(contacts.size(), 1U);
  return pair_stiffnesses(packing, contacts).front();
}

TEST(PairStiffnessTest, ContactShapesHaveTheExpectedStiffTilts) {
  RandomStream random{99};
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    for (int k = 0; k < 4; ++k) {
      const double spin = random.uniform();
      const auto made = [&](const constructed::Site& a, const constructed::Site& b, const Vector3d& tilt,
                            double depth) {
        return stiffness_of(solid, constructed::contact(a, b, spin, tilt, depth), random);
      };
      const auto face = constructed::face_site(solid, 2);
      EXPECT_EQ(made(constructed::vertex_site(solid, k), face, Vector3d::Zero(), 1e-4).stiff_tilts(10), 0);
      const auto edge = constructed::edge_site(solid, k);
      const auto shallow = made(edge, face, Vector3d::Zero(), 1e-6), deeper = made(edge, face, Vector3d::Zero(), 1e-4);
      EXPECT_EQ(shallow.stiff_tilts(10), 1) << to_string(kind);
      EXPECT_NEAR(shallow.relative_tilt(0) / deeper.relative_tilt(0), 100, 5) << to_string(kind);
      // If a flat contact covers the whole polygon, V is the area of the polygon times the depth at its centroid. A
      // tilt about the centroid then does not change V. If the faces separate within the polygon, it does.
      const auto flat = constructed::face_and_edges_site(solid, k);
      const Vector3d in_plane = flat.outward.unitOrthogonal();
      EXPECT_EQ(made(flat, face, 1e-9 * in_plane, 1e-4).stiff_tilts(10), 0) << to_string(kind);
      EXPECT_GE(made(flat, face, 1e-3 * in_plane, 1e-5).stiff_tilts(10), 1) << to_string(kind);
    }
  }
}

TEST(PairStiffnessTest, RowsAreConstraints) {
  for (const Packing& packing : states_to_try()) {
    const Stiff stiff(packing);
    for (const double threshold : {1.0, 10.0, 100.0}) {
      const auto matrix = stiff_constraints(packing, stiff.contacts, stiff.pairs, threshold);
      const MatrixXd rows = matrix.rows;
      EXPECT_LE((rows.rowwise().norm().array() - 1).abs().maxCoeff(), 100 * eps);
      EXPECT_NEAR(stiff_constraint_number(packing.size(), stiff.pairs, threshold) * packing.size() / 2,
                  static_cast<double>(rows.rows()), 1e-9);
      EXPECT_LE((rows.transpose() * matrix.forces - stiff.gradient).norm(), 1e-11 * matrix.forces.norm());
      const auto rigidity = analyse_rigidity(matrix);
      EXPECT_EQ(rigidity.rank, (singular_values_of(MatrixXd(matrix.rows)).array() > rigidity.tolerance).count());
    }
    EXPECT_THROW(stiff_constraints(packing, stiff.contacts, {}, 1), std::invalid_argument);
  }
}

}  // namespace
}  // namespace isojam
