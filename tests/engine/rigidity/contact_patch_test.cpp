// Facts proved here:
//   corners of patches lie in both bodies to within the depth of the contact, in one plane or on one edge; where the
//   margin is positive the contact's own force and torque are a sum of positive pushes at its corners; rows push there;
//   the states of self-stress that linear programmes find with pushes only, from many directions, span as many
//   dimensions as one_sided_stresses() says, in jammed octahedra, tetrahedra and icosahedra; where that is one, forces
//   are those of the equilibrium, also where that is off by far more than rounding;
//   rows are of unit length and blind to translations; lists of different lengths are refused.

#include "engine/rigidity/contact_patch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "tests/engine/rigidity/push_dimension.hpp"
#include "tests/engine/solve/solve_support.hpp"
#include "tests/engine/vibration/jammed_states.hpp"

namespace isojam {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Pushed {
  explicit Pushed(const Packing& state) : packing(state) {
    contacts = PackingEnergy().contacts(packing);
    angles = alignments(packing.solids, contacts);
    classes = analyse_contacts(packing.solids, packing.size(), contacts, angles).classes;
    forces = contact_forces(packing, contacts);
    patches = contact_patches(packing, contacts, forces, angles, classes);
    corners = corner_constraints(packing, contacts, forces, patches);
  }
  OneSidedStresses stresses() const { return one_sided_stresses(packing, contacts, forces, angles, classes); }

  const Packing& packing;
  std::vector<Contact> contacts;
  std::vector<Alignment> angles;
  std::vector<ContactClass> classes;
  std::vector<ContactForce> forces;
  std::vector<ContactPatch> patches;
  RigidityMatrix corners;
};

std::vector<const Packing*> states_to_try() {
  return {&nearest_state(jammed(SolidKind::octahedron, 48, .01)),
          &nearest_state(jammed(SolidKind::tetrahedron, 64, .02)),
          &nearest_state(jammed(SolidKind::icosahedron, 32, .01))};
}

TEST(ContactPatchTest, CornersAreWhereBodiesMeet) {
  for (const Packing* state : states_to_try()) {
    const Pushed pushed(*state);
    const ConvexSolid& solid = state->solids.only();
    for (std::size_t c = 0; c < pushed.contacts.size(); ++c) {
      const auto& patch = pushed.patches[c];
      const RelativePose& pose = pushed.contacts[c].pose;
      const std::size_t expected = pushed.classes[c] == ContactClass::lower_order ? 1U
                                   : pushed.classes[c] == ContactClass::edge_face ? 2U
                                                                                  : 3U;
      EXPECT_TRUE(expected == 3 ? patch.corners.size() >= 3 : patch.corners.size() == expected);
      if (expected == 1) continue;
      constexpr double beside = 1e-12;
      for (const Vector3d& corner : patch.corners) {
        for (const auto& face : solid.faces()) {
          EXPECT_LE(face.normal.dot(corner) - face.offset, beside);
          EXPECT_LE(face.normal.dot(pose.rotation.transpose() * (corner - pose.displacement)) - face.offset, beside);
        }
      }
    }
  }
}

TEST(ContactPatchTest, AForceInsideItsPatchIsASumOfPushes) {
  int inside = 0;
  for (const Packing* state : states_to_try()) {
    const Pushed pushed(*state);
    for (std::size_t c = 0; c < pushed.contacts.size(); ++c) {
      const auto& patch = pushed.patches[c];
      if (patch.corners.size() != 2 || !(patch.margin > 0)) continue;
      ++inside;
      const Eigen::Quaterniond& q = state->poses[static_cast<std::size_t>(pushed.contacts[c].pair.a)].orientation;
      const Vector3d n = q.conjugate() * pushed.forces[c].normal;
      const Vector3d attack =
          q.conjugate() *
          (pushed.forces[c].attack - state->poses[static_cast<std::size_t>(pushed.contacts[c].pair.a)].position);
      // On the line through both ends, seen along the normal: the pushes that balance about each end.
      const Vector3d piece = patch.corners[1] - patch.corners[0];
      const Vector3d along = (piece - n * n.dot(piece)).normalized();
      const double length = along.dot(piece), at = along.dot(attack - patch.corners[0]);
      EXPECT_NEAR(std::min(at, length - at) / length, patch.margin, 1e-9);
      EXPECT_LE(patch.margin, .5 + 1e-12);
    }
  }
  EXPECT_GT(inside, 20);
}

TEST(OneSidedStressesTest, LinearProgrammesSpanAsMany) {
  RandomStream random{43};
  for (const Packing* state : states_to_try()) {
    const Pushed pushed(*state);
    const auto stresses = pushed.stresses();
    std::printf("%d contacts, %d constraints, dimension %d, margins %.3f … %.3f, outside %d\n",
                static_cast<int>(pushed.contacts.size()), stresses.constraints, stresses.dimension,
                stresses.least_margin, stresses.median_margin, stresses.outside);
    ASSERT_EQ(stresses.outside, 0);
    const auto seen = pushed_states(pushed.contacts, pushed.patches, normal_constraints(*state, pushed.contacts),
                                    pushed.corners, random);
    EXPECT_EQ(seen.dimension, stresses.dimension);
    EXPECT_GE(seen.least_new, 1e3 * seen.largest_old) << "the dimension is a matter of opinion";
    EXPECT_LE(seen.most_below, 1e-9);
    EXPECT_LE(seen.most_unbalanced, 1e-8);
  }
}

/// The only state of self-stress is that of the equilibrium: what is missing of it must be allowed for.
TEST(OneSidedStressesTest, AnEquilibriumThatIsOffIsStillSeen) {
  RandomStream random{44};
  const Packing& state = nearest_state(jammed(SolidKind::icosahedron, 32, .01));
  const Packing off = moved(state, 1e-10 * normal_vector(6 * Eigen::Index{state.size()}, random).normalized());
  const Pushed pushed(off);
  const RigidityMatrix normals = normal_constraints(off, pushed.contacts);
  EXPECT_GT(normals.imbalance, 1e-8);
  EXPECT_LT(normals.imbalance, 1e-6);
  const auto stresses = pushed.stresses();
  ASSERT_EQ(stresses.outside, 0);
  EXPECT_EQ(stresses.dimension, 1);
  EXPECT_EQ(pushed_states(pushed.contacts, pushed.patches, normals, pushed.corners, random).dimension, 1);
}

TEST(ContactPatchTest, PushesActAtTheCorners) {
  int polygons = 0, edges = 0;
  for (const Packing* state : states_to_try()) {
    const Pushed pushed(*state);
    const MatrixXd rows = pushed.corners.rows;
    Eigen::Index row = 0;
    for (std::size_t c = 0; c < pushed.contacts.size(); ++c) {
      const auto& patch = pushed.patches[c];
      const int a = pushed.contacts[c].pair.a;
      const Eigen::Quaterniond& q = state->poses[static_cast<std::size_t>(a)].orientation;
      for (const Vector3d& corner : patch.corners) {
        const Vector3d force = q.conjugate() * Vector3d(rows.block<1, 3>(row, 6 * a).transpose());
        const Vector3d torque =
            state->solids.only().gyration_radius() * (q.conjugate() * Vector3d(rows.block<1, 3>(row, 6 * a + 3)));
        ++row;
        // A contact may twist besides, about its own force.
        const Vector3d rest = torque - corner.cross(force), n = force.normalized();
        if (patch.corners.size() > 2) {
          EXPECT_LE(rest.cross(n).norm(), 1e-12 * force.norm());
          ++polygons;
        } else if (patch.corners.size() == 2) {
          const Vector3d piece = patch.corners[1] - patch.corners[0];
          EXPECT_LE(std::abs(rest.dot(n.cross(piece))), 1e-2 * force.norm() * piece.squaredNorm());
          ++edges;
        }
      }
    }
  }
  std::printf("corners of polygons %d, of edges %d\n", polygons, edges);
  EXPECT_GT(polygons, 50);
  EXPECT_GT(edges, 50);
}

TEST(ContactPatchTest, RowsAndRefusals) {
  const Packing& state = nearest_state(jammed(SolidKind::icosahedron, 32, .01));
  const Pushed pushed(state);
  const MatrixXd rows = pushed.corners.rows;
  EXPECT_LE((rows.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
  VectorXd shift = VectorXd::Zero(rows.cols());
  for (int i = 0; i < state.size(); ++i) shift.segment<3>(6 * i) = Vector3d(1, 2, 3);
  EXPECT_LE((rows * shift).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_THROW(contact_patches(state, pushed.contacts, {}, pushed.angles, pushed.classes), std::invalid_argument);
  EXPECT_THROW(corner_constraints(state, pushed.contacts, pushed.forces, {}), std::invalid_argument);
}

}  // namespace
}  // namespace isojam
