// Reference: the same coordinates in quadruple precision. Errors are a few 1e-15 rad, hundreds of times smaller than
// the documented limit of 1e-12.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/analysis/alignment/alignment.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// The angle with this sine and cosine. The sine is in quadruple precision, so that small angles are exact in double.
double angle(Quad sine, Quad cosine) { return std::atan2(static_cast<double>(sine), static_cast<double>(cosine)); }

/// Both angles in quadruple precision, for the features in the masks and the orientations in the packing.
Alignment in_quad(const ConvexSolid& solid, const Packing& packing, const Contact& contact) {
  const SolidArrays& arrays = solid.arrays();
  const QuadMatrix a = quad_rotation(packing.poses[contact.pair.a]), b = quad_rotation(packing.poses[contact.pair.b]);
  const auto direction = [&](const QuadMatrix& rotation, int e) {
    const Edge& edge = solid.edges()[static_cast<std::size_t>(e)];
    const Quad3 along = arrays.vertex(edge.head) - arrays.vertex(edge.tail);
    return rotation * ((1 / norm(along)) * along);
  };
  const auto each = [](const FeatureSet& features, const auto& action) { features.for_each(action); };
  Alignment best;
  best.face_face = std::numbers::pi;
  best.edge_face = std::numbers::pi / 2;
  const Overlap& o = contact.overlap;
  each(o.faces_a, [&](int i) {
    const Quad3 n = a * arrays.normal(i);
    each(o.faces_b, [&](int j) {
      const Quad3 m = b * arrays.normal(j);
      best.face_face = std::min(best.face_face, angle(norm(cross(n, m)), -dot(n, m)));
    });
    each(o.edges_b, [&](int e) {
      const Quad3 along = direction(b, e);
      const double sine = std::abs(static_cast<double>(dot(along, n)));
      best.edge_face = std::min(best.edge_face, angle(sine, norm(cross(along, n))));
    });
  });
  each(o.faces_b, [&](int j) {
    const Quad3 m = b * arrays.normal(j);
    each(o.edges_a, [&](int e) {
      const Quad3 along = direction(a, e);
      const double sine = std::abs(static_cast<double>(dot(along, m)));
      best.edge_face = std::min(best.edge_face, angle(sine, norm(cross(along, m))));
    });
  });
  return best;
}

class AlignmentAccuracyOf : public testing::TestWithParam<SolidKind> {
 protected:
  const ConvexSolid& solid = platonic(GetParam());
  RandomStream random{71, static_cast<std::uint64_t>(GetParam())};

  int any(std::size_t size) { return static_cast<int>(random.uniform() * static_cast<double>(size)); }

  /// A face on a face at `depth`. The pair has a random orientation in the lab frame. B is tilted by `tilt` about a
  /// random axis in the plane of the face.
  Packing pair_of_faces(double tilt, double depth) {
    const constructed::Site a = constructed::face_and_edges_site(solid, any(solid.faces().size()));
    const constructed::Site b = constructed::face_and_edges_site(solid, any(solid.faces().size()));
    const Vector3d axis = a.outward.cross(constructed::random_direction(random)).normalized();
    const Contact contact = constructed::contact(a, b, 6 * random.uniform(), tilt * axis, depth);
    const Quaterniond lab = constructed::random_orientation(random);
    Packing packing{solid, PeriodicCell(2.1 * least_side(solid)), {}};
    packing.poses.push_back({.position = Vector3d(0.3, -0.2, 0.1), .orientation = lab});
    packing.poses.push_back({.position = Vector3d(0.3, -0.2, 0.1) + lab * contact.pose.displacement,
                             .orientation = (lab * Quaterniond(contact.pose.rotation)).normalized()});
    return packing;
  }
};

TEST_P(AlignmentAccuracyOf, NearlyParallelFacesHaveTheAnglesOfQuadruplePrecision) {
  double worst_ff = 0, worst_ef = 0;
  std::vector<double> tilts{0};
  for (double tilt = 1e-16; tilt < 2e-2; tilt *= 10) tilts.push_back(tilt);
  for (const double tilt : tilts) {
    for (int trial = 0; trial < 10; ++trial) {
      // The depth is so large that the faces overlap over their whole width.
      const Packing packing = pair_of_faces(tilt, 1e-2 + 2 * tilt);
      PackingEnergy energy;
      const std::vector<Contact> contacts = energy.contacts(packing);
      ASSERT_EQ(contacts.size(), 1U);
      const Alignment found = alignment(solid, contacts[0]), expected = in_quad(solid, packing, contacts[0]);
      worst_ff = std::max(worst_ff, std::abs(found.face_face - expected.face_face));
      worst_ef = std::max(worst_ef, std::abs(found.edge_face - expected.edge_face));
      // The coordinates of the pair are rounded too; the reference takes this into account.
      EXPECT_NEAR(found.face_face, tilt, 1e-14) << "tilt " << tilt;
    }
  }
  std::printf("%s: θ_ff wrong by %.1e, θ_ef by %.1e at most\n", solid.name().c_str(), worst_ff, worst_ef);
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();  // for about a dozen unit vectors
  EXPECT_LT(worst_ff, rounding);
  EXPECT_LT(worst_ef, rounding);
}

INSTANTIATE_TEST_SUITE_P(Solids, AlignmentAccuracyOf, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

}  // namespace
}  // namespace isojam
