#include "engine/analysis/alignment/alignment.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using constructed::contact;
using constructed::direction;
using constructed::edge_site;
using constructed::face_and_edges_site;
using constructed::face_site;
using constructed::overlapped;
using constructed::random_direction;
using constructed::Site;
using constructed::vertex_site;
using Eigen::Vector3d;
using std::numbers::pi;

// An angle is computed from the pose with about a dozen roundings of unit vectors.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
constexpr double depth = 1e-3;

int pick(RandomStream& random, std::size_t size) {
  return static_cast<int>(random.uniform() * static_cast<double>(size));
}

double dihedral(const ConvexSolid& solid) {
  const Edge& edge = solid.edges().front();
  return pi - std::acos(solid.faces()[edge.left].normal.dot(solid.faces()[edge.right].normal));
}

/// Angle between two unit vectors from half chords (Kahan); it is accurate on [0, π].
double chord_angle(const Vector3d& u, const Vector3d& v) { return 2 * std::atan2((u - v).norm(), (u + v).norm()); }

Vector3d normal_in_a(const ConvexSolid& solid, const Contact& c, int face) {
  return c.pose.rotation * solid.faces()[face].normal;
}

double tilt_from_face(const Vector3d& edge, const Vector3d& normal) {
  return std::abs(pi / 2 - chord_angle(edge, normal));
}

class AlignmentOf : public testing::TestWithParam<SolidKind> {
 protected:
  const ConvexSolid& solid = platonic(GetParam());
  RandomStream random{11, static_cast<std::uint64_t>(GetParam())};

  void expect_masks_of_sites(const Contact& constructed_contact) {
    const Overlap& expected = constructed_contact.overlap;
    const Overlap found = overlapped(solid, constructed_contact).overlap;
    ASSERT_GT(found.volume, 0);
    EXPECT_EQ(found.faces_a, expected.faces_a);
    EXPECT_EQ(found.faces_b, expected.faces_b);
    EXPECT_EQ(found.edges_a, expected.edges_a);
    EXPECT_EQ(found.edges_b, expected.edges_b);
  }

  Site random_site() {
    const int kind = pick(random, 4);
    if (kind == 0) return vertex_site(solid, pick(random, solid.vertices().size()));
    if (kind == 1) return edge_site(solid, pick(random, solid.edges().size()));
    if (kind == 2) return face_site(solid, pick(random, solid.faces().size()));
    return face_and_edges_site(solid, pick(random, solid.faces().size()));
  }
};

TEST_P(AlignmentOf, TiltedFacesGiveTheTilt) {
  for (double tilt = 1e-12; tilt < 1.001; tilt *= std::pow(10, 0.25)) {
    const Site a = face_site(solid, pick(random, solid.faces().size()));
    const Site b = face_site(solid, pick(random, solid.faces().size()));
    const Vector3d axis = a.outward.cross(random_direction(random)).normalized();
    const Alignment found = alignment(solid, contact(a, b, 2 * pi * random.uniform(), tilt * axis, depth));
    EXPECT_NEAR(found.face_face, tilt, rounding) << "tilt " << tilt;
    EXPECT_EQ(found.edge_face, pi / 2);
  }
}

TEST_P(AlignmentOf, RaisedEdgeGivesItsElevation) {
  for (double tilt = 1e-12; tilt < 1.001; tilt *= std::pow(10, 0.25)) {
    const int edge = pick(random, solid.edges().size());
    const Site a = edge_site(solid, edge), b = face_site(solid, pick(random, solid.faces().size()));
    const Vector3d axis = a.outward.cross(direction(solid, edge));
    const Contact c = contact(a, b, 2 * pi * random.uniform(), tilt * axis, depth);
    const Alignment of_a = alignment(solid, c), of_b = alignment(solid, constructed::exchanged(c));
    EXPECT_NEAR(of_a.edge_face, tilt, rounding) << "tilt " << tilt;
    EXPECT_NEAR(of_b.edge_face, tilt, rounding) << "tilt " << tilt;
    EXPECT_TRUE(of_a.edge_of_a);
    EXPECT_FALSE(of_b.edge_of_a);
    EXPECT_EQ(of_a.edge, edge);
    EXPECT_EQ(of_b.edge, edge);
  }
}

TEST_P(AlignmentOf, VertexOnFaceGivesTheVertexFigure) {
  for (std::size_t v = 0; v < solid.vertices().size(); ++v) {
    const Site a = vertex_site(solid, static_cast<int>(v)), b = face_site(solid, pick(random, solid.faces().size()));
    const Contact c = contact(a, b, 2 * pi * random.uniform(), Vector3d::Zero(), depth);
    expect_masks_of_sites(c);
    const Alignment found = alignment(solid, c);
    // {p, q}: cos θ_ef = cos(π/p)/sin(π/q), sin θ_ff = cos(δ/2)/sin(π/q).
    const double p = static_cast<double>(solid.faces().front().vertices.size());
    const double q = 2 * static_cast<double>(solid.edges().size()) / static_cast<double>(solid.vertices().size());
    EXPECT_NEAR(std::cos(found.edge_face), std::cos(pi / p) / std::sin(pi / q), rounding);
    EXPECT_NEAR(std::sin(found.face_face), std::cos(dihedral(solid) / 2) / std::sin(pi / q), rounding);
    EXPECT_LT(found.face_face, pi / 2);
  }
}

TEST_P(AlignmentOf, CrossedEdgesGiveTheClosedFormAtAnyAngle) {
  const double sine = std::sin(dihedral(solid) / 2), cosine = std::cos(dihedral(solid) / 2);
  for (int trial = 0; trial < 40; ++trial) {
    const int edge_a = pick(random, solid.edges().size()), edge_b = pick(random, solid.edges().size());
    const Contact c =
        contact(edge_site(solid, edge_a), edge_site(solid, edge_b), 2 * pi * random.uniform(), Vector3d::Zero(), depth);
    const double crossing = chord_angle(direction(solid, edge_a), c.pose.rotation * direction(solid, edge_b));
    const Alignment found = alignment(solid, c);
    EXPECT_NEAR(std::cos(found.face_face), sine * sine + cosine * cosine * std::abs(std::cos(crossing)), rounding);
    EXPECT_NEAR(std::sin(found.edge_face), cosine * std::sin(crossing), rounding);
    // If edges cross at a small angle, the contact reaches beyond their ends.
    if (std::sin(crossing) > 0.2) expect_masks_of_sites(c);
  }
}

TEST_P(AlignmentOf, EngineFindsOverlappingFaces) {
  for (double tilt = 1e-10; tilt < 2e-4; tilt *= 10) {
    const int face_a = pick(random, solid.faces().size()), face_b = pick(random, solid.faces().size());
    const Site a = face_and_edges_site(solid, face_a), b = face_and_edges_site(solid, face_b);
    const Vector3d axis = a.outward.cross(random_direction(random)).normalized();
    const Contact c = overlapped(solid, contact(a, b, 0.3, tilt * axis, depth));
    ASSERT_GT(c.overlap.volume, 0);
    const Alignment found = alignment(solid, c);
    EXPECT_EQ(found.face_a, face_a);
    EXPECT_EQ(found.face_b, face_b);
    EXPECT_NEAR(found.face_face, tilt, rounding) << "tilt " << tilt;
    EXPECT_LE(found.edge_face, tilt + rounding) << "edges of a face deviate less than the face";
  }
}

TEST_P(AlignmentOf, AnglesAreTheSmallestOverTheMasks) {
  const auto in = [](const FeatureSet& features, std::size_t k) {
    return features.contains(static_cast<std::uint32_t>(k));
  };
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d tilt = random_direction(random) * random.uniform();
    const Contact c = contact(random_site(), random_site(), 2 * pi * random.uniform(), tilt, depth);
    double face_face = pi, edge_face = pi / 2;
    for (std::size_t i = 0; i < solid.faces().size(); ++i) {
      for (std::size_t j = 0; j < solid.faces().size(); ++j) {
        if (!in(c.overlap.faces_a, i) || !in(c.overlap.faces_b, j)) continue;
        face_face =
            std::min(face_face, chord_angle(solid.faces()[i].normal, -normal_in_a(solid, c, static_cast<int>(j))));
      }
      for (std::size_t e = 0; e < solid.edges().size(); ++e) {
        const Vector3d edge = direction(solid, static_cast<int>(e));
        const int face = static_cast<int>(i);
        if (in(c.overlap.edges_a, e) && in(c.overlap.faces_b, i)) {
          edge_face = std::min(edge_face, tilt_from_face(edge, normal_in_a(solid, c, face)));
        }
        if (in(c.overlap.edges_b, e) && in(c.overlap.faces_a, i)) {
          edge_face = std::min(edge_face, tilt_from_face(c.pose.rotation * edge, solid.faces()[i].normal));
        }
      }
    }
    const Alignment found = alignment(solid, c);
    EXPECT_NEAR(found.face_face, face_face, rounding);
    EXPECT_NEAR(found.edge_face, edge_face, rounding);
    const Vector3d opposite = -normal_in_a(solid, c, found.face_b);
    EXPECT_NEAR(chord_angle(solid.faces()[found.face_a].normal, opposite), found.face_face, rounding);
    if (found.edge < 0) continue;
    const Vector3d edge = direction(solid, found.edge);
    const double of_features = found.edge_of_a
                                   ? tilt_from_face(edge, normal_in_a(solid, c, found.face))
                                   : tilt_from_face(c.pose.rotation * edge, solid.faces()[found.face].normal);
    EXPECT_NEAR(of_features, found.edge_face, rounding);
  }
}

TEST_P(AlignmentOf, MissingFeaturesGiveTheLargestAngles) {
  Contact c = contact(face_and_edges_site(solid, 0), face_and_edges_site(solid, 1), 0.2, Vector3d::Zero(), depth);
  EXPECT_NEAR(alignment(solid, c).edge_face, 0, rounding);
  c.overlap.edges_a = c.overlap.edges_b = 0;
  EXPECT_EQ(alignment(solid, c).edge_face, pi / 2);
  EXPECT_EQ(alignment(solid, c).edge, -1);
  EXPECT_EQ(alignment(solid, c).face, -1);
  c.overlap.faces_b = 0;
  EXPECT_EQ(alignment(solid, c).face_face, pi);
  EXPECT_EQ(alignment(solid, c).face_a, -1);
}

INSTANTIATE_TEST_SUITE_P(Solids, AlignmentOf, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

}  // namespace
}  // namespace isojam
