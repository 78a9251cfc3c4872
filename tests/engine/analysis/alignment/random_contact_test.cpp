#include "engine/analysis/alignment/random_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/analysis/alignment/alignment.hpp"
#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/analysis/constructed_contacts.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

double angle_between(const Vector3d& u, const Vector3d& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

const Face& face_of(const ConvexSolid& solid, int face) { return solid.faces()[static_cast<std::size_t>(face)]; }

/// An edge and the normals of its two faces.
struct Side {
  Vector3d edge, left, right;
};
Side side_of(const ConvexSolid& solid, std::size_t k) {
  const Edge& edge = solid.edges()[k];
  return {solid.vertices()[static_cast<std::size_t>(edge.head)] - solid.vertices()[static_cast<std::size_t>(edge.tail)],
          face_of(solid, edge.left).normal, face_of(solid, edge.right).normal};
}

double exterior(const ConvexSolid& solid) {
  const Side side = side_of(solid, 0);
  return angle_between(side.left, side.right);
}

/// A parallelogram of the Minkowski sum.
struct Drawn {
  std::size_t edge_a, edge_b;
  Vector3d normal;  ///< outward from A
  double area, face_face, edge_face;
};

/// True if the arc between the normals of edge a crosses the arc between the negative normals of edge b. `at` is then
/// the intersection.
bool crosses(const Side& a, const Side& b, Vector3d& at) {
  const Vector3d across_a = a.left.cross(a.right), across_b = b.left.cross(b.right);
  at = across_a.cross(across_b).normalized();
  const auto within = [&](const Vector3d& n, const Vector3d& from, const Vector3d& to, const Vector3d& across) {
    return across.dot(from.cross(n)) > 0 && across.dot(n.cross(to)) > 0;
  };
  for (int sign = 0; sign < 2; ++sign, at = -at) {
    if (within(at, a.left, a.right, across_a) && within(-at, b.left, b.right, across_b)) return true;
  }
  return false;
}

/// Appends all parallelograms of A + (−B) to the list, where B is rotated.
void draw(const ConvexSolid& a, const ConvexSolid& b, const Eigen::Quaterniond& turn, std::vector<Drawn>& list) {
  for (std::size_t i = 0; i < a.edges().size(); ++i) {
    const Side one = side_of(a, i);
    for (std::size_t j = 0; j < b.edges().size(); ++j) {
      Side other = side_of(b, j);
      for (Vector3d* each : {&other.edge, &other.left, &other.right}) *each = turn * *each;
      Vector3d at;
      if (!crosses(one, other, at)) continue;
      Drawn drawn{i, j, at, one.edge.cross(other.edge).norm(), pi, 1};
      for (const Vector3d& n : {one.left, one.right}) {
        for (const Vector3d& m : {other.left, other.right})
          drawn.face_face = std::min(drawn.face_face, angle_between(n, -m));
        drawn.edge_face = std::min(drawn.edge_face, std::abs(n.dot(other.edge.normalized())));
      }
      for (const Vector3d& m : {other.left, other.right})
        drawn.edge_face = std::min(drawn.edge_face, std::abs(m.dot(one.edge.normalized())));
      drawn.edge_face = std::asin(drawn.edge_face);
      list.push_back(drawn);
    }
  }
}

/// Largest distance between the CDF of weighted values and a distribution.
double distance(std::vector<std::pair<double, double>> values, const std::function<double(double)>& distribution) {
  std::sort(values.begin(), values.end());
  double sum = 0, cumulative = 0, greatest = 0;
  for (const auto& [value, weight] : values) sum += weight;
  for (const auto& [value, weight] : values) {
    const double expected = distribution(value);
    greatest = std::max(greatest, std::abs(expected - cumulative / sum));
    cumulative += weight;
    greatest = std::max(greatest, std::abs(expected - cumulative / sum));
  }
  return greatest;
}

TEST(ContactShares, AgreeWithKnownValues) {
  const auto share = [](SolidKind kind) { return RandomContact(platonic(kind)).edge_edge_share(); };
  EXPECT_EQ(std::lround(100 * share(SolidKind::tetrahedron)), 60);
  EXPECT_EQ(std::lround(100 * share(SolidKind::octahedron)), 56);
  EXPECT_EQ(std::lround(100 * share(SolidKind::dodecahedron)), 52);
  EXPECT_EQ(std::lround(100 * share(SolidKind::icosahedron)), 52);
  const ContactSize cube = contact_size(platonic(SolidKind::cube));
  EXPECT_NEAR(cube.surface, 6, 1e-13);
  EXPECT_NEAR(cube.mean_curvature, 3 * pi, 1e-13);
  const ContactSize large = contact_size(ConvexSolid(platonic(SolidKind::cube), 3));
  EXPECT_NEAR(large.surface, 54, 1e-12);
  EXPECT_NEAR(large.mean_curvature, 9 * pi, 1e-12);
  const ContactShares shares = contact_shares(cube, large), exchanged = contact_shares(large, cube);
  EXPECT_NEAR(shares.vertex_of_a + shares.vertex_of_b + shares.edge_edge, 1, 1e-15);
  EXPECT_NEAR(shares.vertex_of_a, 9 * shares.vertex_of_b, 1e-14) << "vertices of the small one lie on the large one";
  EXPECT_EQ(shares.vertex_of_a, exchanged.vertex_of_b);
  EXPECT_EQ(shares.edge_edge, exchanged.edge_edge);
}

/// Checks that drawn angles follow the given distributions.
void expect_followed(const ConvexSolid& a, const ConvexSolid& b, int turns, RandomStream& random) {
  std::vector<Drawn> drawn;
  for (int k = 0; k < turns; ++k) draw(a, b, constructed::random_orientation(random), drawn);
  double area = 0;
  std::vector<std::pair<double, double>> face_face, edge_face, by_number;
  for (const Drawn& each : drawn) {
    area += each.area / turns;
    face_face.emplace_back(each.face_face, each.area);
    edge_face.emplace_back(each.edge_face, each.area);
    by_number.emplace_back(each.edge_face, 1);
  }
  const double expected = contact_size(a).mean_curvature * contact_size(b).mean_curvature / (2 * pi);
  EXPECT_NEAR(area, expected, 0.01 * expected);
  const RandomEdgeContact ideal(a, b);
  const double ff = distance(face_face, [&](double theta) { return ideal.face_face(theta); });
  const double ef = distance(edge_face, [&](double theta) { return ideal.edge_face(theta); });
  const double other = distance(by_number, [&](double theta) { return ideal.edge_face(theta); });
  std::printf("%s and %s: %zu parallelograms, area %.4f of %.4f, distances %.4f and %.4f, by number %.4f\n",
              a.name().c_str(), b.name().c_str(), drawn.size(), area, expected, ff, ef, other);
  // The angles of one rotation are not independent. The tolerance is therefore twice the 1 % level, plus the error of
  // the numerical integration with fixed points.
  const double allowed = 2 * 1.63 / std::sqrt(static_cast<double>(drawn.size())) + 2e-3;
  EXPECT_LE(ff, allowed);
  EXPECT_LE(ef, allowed);
  EXPECT_GT(other, 2 * allowed);
}

TEST(RandomEdgeContact, FollowsMinkowskiSums) {
  RandomStream random{61};
  for (const SolidKind kind : all_solids) {
    const int turns = platonic(kind).edges().size() > 12 ? 4000 : 20000;
    expect_followed(platonic(kind), platonic(kind), turns, random);
  }
  expect_followed(platonic(SolidKind::tetrahedron), platonic(SolidKind::dodecahedron), 8000, random);
  const Solid truncated = *Solid::named("truncated_tetrahedron"), prism = *Solid::named("prism6");
  expect_followed(*truncated, *prism, 8000, random);
}

TEST(RandomEdgeContact, DrawnAnglesAreThoseOfTouchingEdges) {
  RandomStream random{62};
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    std::vector<Drawn> drawn;
    for (int k = 0; k < 10; ++k) {
      const Eigen::Quaterniond turn = constructed::random_orientation(random);
      const std::size_t before = drawn.size();
      draw(solid, solid, turn, drawn);
      for (std::size_t i = before; i < drawn.size(); ++i) {
        constructed::Site a = constructed::edge_site(solid, static_cast<int>(drawn[i].edge_a)),
                          b = constructed::edge_site(solid, static_cast<int>(drawn[i].edge_b));
        a.outward = drawn[i].normal;
        b.outward = turn.conjugate() * -drawn[i].normal;
        // The angle about the normal that rotates the edge of B into its direction.
        const Vector3d along = constructed::direction(solid, static_cast<int>(drawn[i].edge_b));
        const Vector3d wanted = turn * along;
        const Vector3d found = constructed::contact(a, b, 0, Vector3d::Zero(), 1e-9).pose.rotation * along;
        const double spin = std::atan2(found.cross(wanted).dot(-a.outward), found.dot(wanted));
        const Contact contact = constructed::contact(a, b, spin, Vector3d::Zero(), 1e-9);
        ASSERT_LE((contact.pose.rotation - turn.toRotationMatrix()).norm(), 1e-12);
        const Alignment angles = alignment(solid, contact);
        EXPECT_NEAR(angles.face_face, drawn[i].face_face, 1e-12);
        EXPECT_NEAR(angles.edge_face, drawn[i].edge_face, 1e-12);
      }
    }
    EXPECT_GT(drawn.size(), 50U);
  }
}

TEST(RandomEdgeContact, RisesFromZeroToOne) {
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    const RandomEdgeContact ideal(solid, solid), again(solid, solid);
    const CriticalAngles critical = critical_angles(solid);
    EXPECT_NEAR(ideal.ff_max(), critical.ff_edge_edge, 1e-14);
    EXPECT_NEAR(ideal.ef_max(), critical.ef_edge_edge, 1e-14);
    const auto expect_rise = [](const std::function<double(double)>& distribution, double largest, double slope) {
      EXPECT_EQ(distribution(0), 0);
      EXPECT_EQ(distribution(largest), 1);
      for (double theta = 1e-6, before = distribution(1e-6); theta < largest; theta *= 1.001) {
        const double here = distribution(theta);
        EXPECT_GE(here, before) << theta;
        EXPECT_LE(here, before * 1.04 + slope * 1e-3 * theta) << "a step at " << theta;
        before = here;
      }
    };
    expect_rise([&](double theta) { return ideal.face_face(theta); }, ideal.ff_max(), 30);
    expect_rise([&](double theta) { return ideal.edge_face(theta); }, ideal.ef_max(), 30);
    const double alpha = exterior(solid);
    for (const double theta : {1e-5, 1e-4, 1e-3}) {
      EXPECT_NEAR(ideal.face_face(theta) / (theta * theta), 4 / (alpha * alpha), 0.03 * 4 / (alpha * alpha)) << theta;
      EXPECT_NEAR(ideal.edge_face(theta) / theta, 16 / (pi * alpha), 0.03 * 16 / (pi * alpha)) << theta;
      EXPECT_EQ(ideal.face_face(theta), again.face_face(theta));
    }
  }
}

TEST(RandomContact, IsTheSumOfBothKinds) {
  for (const SolidKind kind : all_solids) {
    const ConvexSolid& solid = platonic(kind);
    const RandomContact all(solid);
    const RandomAlignment vertices(solid);
    const RandomEdgeContact edges(solid, solid);
    const double part = all.edge_edge_share();
    for (double theta = 1e-4; theta < 1.5; theta *= 1.3) {
      EXPECT_NEAR(all.face_face(theta), (1 - part) * vertices.face_face(theta) + part * edges.face_face(theta), 1e-15);
      EXPECT_NEAR(all.edge_face(theta), (1 - part) * vertices.edge_face(theta) + part * edges.edge_face(theta), 1e-15);
    }
    EXPECT_EQ(all.ff_max(), std::max(vertices.ff_max(), edges.ff_max()));
    EXPECT_EQ(all.ef_max(), std::max(vertices.ef_max(), edges.ef_max()));
    EXPECT_NEAR(all.face_face(all.ff_max()), 1, 1e-15);
    EXPECT_NEAR(all.edge_face(all.ef_max()), 1, 1e-15);
  }
}

}  // namespace
}  // namespace isojam
