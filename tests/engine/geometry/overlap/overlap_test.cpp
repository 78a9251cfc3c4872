#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/overlap/clipped_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using namespace testing_pairs;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int cases = 20;

/// Upper limit of the rounding errors: of V relative to V, of S relative to |S|, of M relative to |S|·reach. The depth
/// of the contact is about V/|S|. The error of a coordinate is a few ulp of the reach, the size of the pair.
double rounding(const Pair& pair, const Overlap& contact) {
  return 64 * epsilon * pair.reach() * contact.area.norm() / contact.volume;
}

template <class Check>
void for_each_contact(std::uint64_t seed, const Check& check) {
  RandomStream random{3, seed};
  for (const SolidKind a : all_solids) {
    for (const SolidKind b : all_solids) {
      for (int k = 0; k < cases; ++k) check(random_contact(random, a, b, 1e-5, 3e-2), random);
    }
  }
}

TEST(OverlapTest, ExchangingTheSolidsChangesNothing) {
  for_each_contact(1, [](const Pair& pair, RandomStream&) {
    const Overlap from_a = overlap(pair), from_b = overlap(exchanged(pair));
    const RelativePose pose = pair.relative();
    const Vector3d area_b = pose.rotation * from_b.area, moment_b = pose.rotation * from_b.moment;
    const double limit = rounding(pair, from_a), scale = from_a.area.norm();
    EXPECT_NEAR(from_b.volume, from_a.volume, limit * from_a.volume) << describe(pair);
    EXPECT_LE((area_b + from_a.area).norm(), limit * scale) << describe(pair);
    EXPECT_LE((moment_b - moment_of_b(from_a, pose)).norm(), limit * scale * pair.reach()) << describe(pair);
    EXPECT_EQ(from_b.faces_a, from_a.faces_b) << describe(pair);
    EXPECT_EQ(from_b.faces_b, from_a.faces_a) << describe(pair);
    EXPECT_EQ(from_b.edges_a, from_a.edges_b) << describe(pair);
    EXPECT_EQ(from_b.edges_b, from_a.edges_a) << describe(pair);
  });
}

TEST(OverlapTest, RotatingBothSolidsChangesNothing) {
  for_each_contact(2, [](const Pair& pair, RandomStream& random) {
    Pair rotated = pair;
    const Quaterniond rotation = random_orientation(random);
    for (Pose* pose : {&rotated.a, &rotated.b}) {
      pose->orientation = (rotation * pose->orientation).normalized();
      pose->position = rotation * pose->position;
    }
    const Overlap before = overlap(pair), after = overlap(rotated);
    const double limit = rounding(pair, before), scale = before.area.norm();
    EXPECT_NEAR(after.volume, before.volume, limit * before.volume) << describe(pair);
    EXPECT_LE((after.area - before.area).norm(), limit * scale) << describe(pair);
    EXPECT_LE((after.moment - before.moment).norm(), limit * scale * pair.reach()) << describe(pair);
  });
}

/// A contact that was constructed. At depth δ, B has this orientation and its centre is at start − δ·normal, in the
/// frame of A.
struct ConstructedContact {
  SolidKind kind;
  Quaterniond orientation;
  Vector3d start;   ///< x_B at depth 0
  Vector3d normal;  ///< outward from A
  FeatureSet faces_a{}, faces_b{}, edges_a{}, edges_b{};

  Pair at(double depth) const { return {kind, kind, {}, {start - depth * normal, orientation}}; }
  double volume(double depth) const { return overlap(at(depth)).volume; }
};

Quaterniond rotation_about(const Vector3d& axis, double angle) { return Quaterniond(Eigen::AngleAxisd(angle, axis)); }

Vector3d middle(const ConvexSolid& solid, const Edge& edge) {
  return (solid.vertices()[edge.tail] + solid.vertices()[edge.head]) / 2;
}

/// Places B on the point `on` of A. `feature` is a point of the surface of B, and `outward` the direction there. B is
/// rotated so that `outward` points along −normal, and then by `spin` about the normal.
ConstructedContact facing(SolidKind kind, const Vector3d& on, const Vector3d& normal, const Vector3d& feature,
                          const Vector3d& outward, double spin) {
  const Quaterniond q = rotation_about(normal, spin) * Quaterniond::FromTwoVectors(outward, -normal);
  return {kind, q.normalized(), on - q.normalized() * feature, normal};
}

std::uint64_t bit(int k) { return std::uint64_t{1} << k; }

ConstructedContact vertex_on_face(SolidKind kind, double spin) {
  const ConvexSolid& solid = platonic(kind);
  const Face& face = solid.faces()[1];
  const Vector3d& vertex = solid.vertices()[2];
  ConstructedContact contact = facing(kind, face.offset * face.normal, face.normal, vertex, vertex.normalized(), spin);
  contact.faces_a = bit(1);
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const Edge& edge = solid.edges()[e];
    if (edge.tail != 2 && edge.head != 2) continue;
    contact.edges_b |= bit(static_cast<int>(e));
    contact.faces_b |= bit(edge.left) | bit(edge.right);
  }
  return contact;
}

ConstructedContact edge_on(SolidKind kind, const Vector3d& on, const Vector3d& normal, double spin) {
  const ConvexSolid& solid = platonic(kind);
  const Edge& edge = solid.edges()[1];
  const Vector3d m = middle(solid, edge);
  ConstructedContact contact = facing(kind, on, normal, m, m.normalized(), spin);
  contact.edges_b = bit(1);
  contact.faces_b = bit(edge.left) | bit(edge.right);
  return contact;
}

ConstructedContact edge_on_edge(SolidKind kind, double crossing_angle) {
  const ConvexSolid& solid = platonic(kind);
  const Edge& edge = solid.edges()[0];
  const Vector3d m = middle(solid, edge), normal = m.normalized();
  ConstructedContact contact = edge_on(kind, m, normal, 0);
  // Rotate until the edges cross at the given angle.
  const Vector3d p = (solid.vertices()[edge.head] - solid.vertices()[edge.tail]).normalized();
  const Edge& other = solid.edges()[1];
  const Vector3d q = contact.orientation * (solid.vertices()[other.head] - solid.vertices()[other.tail]).normalized();
  const double now = std::atan2(p.cross(q).dot(normal), p.dot(q));
  contact = edge_on(kind, m, normal, crossing_angle - now);
  contact.edges_a = bit(0);
  contact.faces_a = bit(edge.left) | bit(edge.right);
  return contact;
}

ConstructedContact edge_on_face(SolidKind kind, double spin) {
  const Face& face = platonic(kind).faces()[1];
  ConstructedContact contact = edge_on(kind, face.offset * face.normal, face.normal, spin);
  contact.faces_a = bit(1);
  return contact;
}

/// The contact of edge 1 of B with face 1 of A, with all features that have a vertex in common with them.
ConstructedContact with_neighbours(ConstructedContact contact) {
  const ConvexSolid& solid = platonic(contact.kind);
  const auto meets = [](const Edge& edge, const auto& vertices) {
    return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return v == edge.tail || v == edge.head; });
  };
  const std::array ends{solid.edges()[1].tail, solid.edges()[1].head};
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const Edge& edge = solid.edges()[e];
    const auto add = [&](FeatureSet& edges, FeatureSet& faces) {
      edges |= bit(static_cast<int>(e));
      faces |= bit(edge.left) | bit(edge.right);
    };
    if (meets(edge, solid.faces()[1].vertices)) add(contact.edges_a, contact.faces_a);
    if (meets(edge, ends)) add(contact.edges_b, contact.faces_b);
  }
  return contact;
}

ConstructedContact face_on_face(SolidKind kind, double spin) {
  const Face &face = platonic(kind).faces()[1], &other = platonic(kind).faces()[0];
  return facing(kind, face.offset * face.normal, face.normal, other.offset * other.normal, other.normal, spin);
}

/// d log V/d log δ between δ and 2δ.
double exponent(const ConstructedContact& contact, double depth) {
  return std::log2(contact.volume(2 * depth) / contact.volume(depth));
}

class OverlapOfConstructedContacts : public testing::TestWithParam<SolidKind> {
 protected:
  double size() const { return platonic(GetParam()).inradius(); }
  /// Rotation angles for which no features of the two solids are aligned.
  static constexpr double spins[] = {0.13, 0.29, 1.07};
};

INSTANTIATE_TEST_SUITE_P(Solids, OverlapOfConstructedContacts, testing::ValuesIn(all_solids),
                         [](const auto& solid) { return std::string(to_string(solid.param)); });

TEST_P(OverlapOfConstructedContacts, VertexOnFaceAndEdgeOnEdgeAreCubic) {
  for (const double spin : spins) {
    for (const double depth : {1e-2 * size(), 1e-4 * size()}) {
      // The overlap is a pyramid or a tetrahedron whose shape is the same at every depth.
      const double limit = 256 * epsilon * size() / depth;
      EXPECT_NEAR(exponent(vertex_on_face(GetParam(), spin), depth), 3, limit) << "spin " << spin << ", δ " << depth;
      EXPECT_NEAR(exponent(edge_on_edge(GetParam(), spin + 0.5), depth), 3, limit)
          << "spin " << spin << ", δ " << depth;
    }
  }
}

TEST_P(OverlapOfConstructedContacts, EdgeOnFaceIsQuadraticAndFaceOnFaceLinear) {
  for (const double spin : spins) {
    for (const double depth : {1e-3 * size(), 1e-5 * size()}) {
      // Contributions from the ends of the edge and the rim of the face are smaller by a factor of depth/size.
      const double limit = 8 * depth / size();
      EXPECT_NEAR(exponent(edge_on_face(GetParam(), spin), depth), 2, limit) << "spin " << spin << ", δ " << depth;
      EXPECT_NEAR(exponent(face_on_face(GetParam(), spin), depth), 1, limit) << "spin " << spin << ", δ " << depth;
    }
  }
}

TEST_P(OverlapOfConstructedContacts, VectorAreaIsTheDerivativeOfTheVolume) {
  const double depth = 1e-2 * size(), h = 1e-5 * size();
  for (const double spin : spins) {
    const ConstructedContact contact = vertex_on_face(GetParam(), spin);
    const Overlap there = overlap(contact.at(depth));
    const double slope = (contact.volume(depth + h) - contact.volume(depth - h)) / (2 * h);
    // For V = cδ³ the error of the central difference is ch², compared with the slope 3cδ².
    EXPECT_NEAR(there.area.dot(contact.normal), slope, (h * h / (depth * depth) + 1e-9) * slope) << "spin " << spin;
    EXPECT_LE(there.area.cross(contact.normal).norm(), 1e-12 * there.area.norm()) << "spin " << spin;
  }
}

TEST_P(OverlapOfConstructedContacts, FeaturesAreAsConstructed) {
  const double depth = 1e-3 * size();
  for (const double spin : spins) {
    for (const ConstructedContact& contact :
         {vertex_on_face(GetParam(), spin), edge_on_edge(GetParam(), spin + 0.5), edge_on_face(GetParam(), spin)}) {
      const Overlap seen = overlap(contact.at(depth));
      const Overlap clipped = clipped_overlap(platonic(GetParam()), platonic(GetParam()), contact.at(depth).relative());
      // For an edge on a face, features near the ends of the edge are also reported.
      const bool ends = contact.edges_a.empty() && contact.edges_b.count() == 1;
      const ConstructedContact allowed = ends ? with_neighbours(contact) : contact;
      for (const Overlap& result : {seen, clipped}) {
        EXPECT_EQ(result.faces_a & contact.faces_a, contact.faces_a) << "spin " << spin;
        EXPECT_EQ(result.faces_b & contact.faces_b, contact.faces_b) << "spin " << spin;
        EXPECT_EQ(result.edges_b & contact.edges_b, contact.edges_b) << "spin " << spin;
        EXPECT_EQ(result.edges_a & contact.edges_a, contact.edges_a) << "spin " << spin;
        EXPECT_EQ(result.faces_a & allowed.faces_a, result.faces_a) << "spin " << spin;
        EXPECT_EQ(result.faces_b & allowed.faces_b, result.faces_b) << "spin " << spin;
        EXPECT_EQ(result.edges_a & allowed.edges_a, result.edges_a) << "spin " << spin;
        EXPECT_EQ(result.edges_b & allowed.edges_b, result.edges_b) << "spin " << spin;
      }
    }
  }
}

}  // namespace
}  // namespace isojam
