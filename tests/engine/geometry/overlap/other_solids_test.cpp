// Facts proved here, of overlap() in double-double against clipping in quadruple precision, over all pairs of solids
// that are not Platonic, and of each with a cube:
//   V, S and M of faces in contact, depth 1e-4 … 1e-12 and tilted by as much, are right to 1e-13, half of
//   them to 1e-15, by the loop;
//   of corners in faces and crossed edges, V 1e-3 … 1e-15, to 1e-12;
//   the Hessian is the difference of S and M in quadruple precision, to 1e-8 of the block of translations;
//   pairs that coincide, and faces that lie in each other to the last bit, are right to 1e-14 by whichever path.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;
using testing_pairs::random_direction;
using testing_pairs::random_orientation;

/// Boxes, prisms, what the program knows by name, and ten points on a sphere.
const std::vector<Solid>& others() {
  static const std::vector<Solid> solids = [] {
    std::vector<Vector3d> brick, rock;
    for (int k = 0; k < 8; ++k) brick.emplace_back(k & 1 ? 1 : 0, k & 2 ? 1.5 : 0, k & 4 ? 2 : 0);
    RandomStream random{71};
    for (int k = 0; k < 10; ++k) rock.push_back(random_direction(random));
    return std::vector<Solid>{*Solid::named("truncated_tetrahedron"),
                              *Solid::named("cuboctahedron"),
                              *Solid::named("rhombic_dodecahedron"),
                              *Solid::named("prism6"),
                              *Solid::named("antiprism5"),
                              *Solid::named("antiprism8"),
                              Solid::made_of("brick", brick),
                              Solid::made_of("rock", rock),
                              *Solid::named("cube")};
  }();
  return solids;
}

struct Placed {
  const ConvexSolid &a, &b;
  Pose at_a, at_b;
};

Quad3 displacement(const Placed& pair) { return quad_position(pair.at_b) - quad_position(pair.at_a); }

DoubleDoubleVector narrow(const Quad3& p) {
  DoubleDoubleVector result;
  for (int c = 0; c < 3; ++c) result.set(c, narrowed(p[c]));
  return result;
}

QuadOverlap exact(const Placed& pair) {
  QuadOverlap result = clipped_overlap(pair.a, pair.b, relative_pose(pair.at_a, pair.at_b, displacement(pair)));
  result.area = quad_rotation(pair.at_a) * result.area;
  result.moment = quad_rotation(pair.at_a) * result.moment;
  return result;
}

Overlap found(const Placed& pair, OverlapHessian& hessian) {
  SeparatingAxis axis;
  return overlap_with_hessian(LonePlacedSolid(pair.a, rotation_matrix(pair.at_a)),
                              LonePlacedSolid(pair.b, rotation_matrix(pair.at_b)), narrow(displacement(pair)), axis,
                              hessian);
}

/// Largest error of V over V, of S over |S|, of M over |S| and the inradius.
double error(const Placed& pair) {
  const QuadOverlap right = exact(pair);
  OverlapHessian unused;
  const Overlap got = found(pair, unused);
  const double volume = static_cast<double>(right.volume), area = static_cast<double>(norm(right.area));
  const auto off = [](const Quad3& p, const Vector3d& q) {
    return static_cast<double>(norm(p - Quad3{q.x(), q.y(), q.z()}));
  };
  return std::max({std::abs(static_cast<double>(Quad(got.volume) - right.volume)) / volume,
                   off(right.area, got.area) / area, off(right.moment, got.moment) / (area * pair.a.inradius())});
}

/// B, turned so that a face of it is on a face of A to within `tilt`, `depth` deep and beside its middle.
Placed flat_contact(const Solid& a, const Solid& b, double depth, double tilt, RandomStream& random) {
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random.uniform() * static_cast<double>(n)); };
  const Face &face_a = a->faces()[pick(a->faces().size())], &face_b = b->faces()[pick(b->faces().size())];
  Placed pair{*a, *b, {}, {}};
  pair.at_a.orientation = random_orientation(random);
  const Vector3d up = pair.at_a.orientation * face_a.normal;
  const auto onto = Eigen::Quaterniond::FromTwoVectors(face_b.normal, -up);
  const Eigen::Quaterniond about(Eigen::AngleAxisd(6.28 * random.uniform(), up));
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(tilt, up.unitOrthogonal()));
  pair.at_b.orientation = (tilted * about * onto).normalized();
  Vector3d beside = .3 * a->inradius() * random_direction(random);
  beside -= beside.dot(up) * up;
  Vector3d middle_a = Vector3d::Zero(), middle_b = Vector3d::Zero();
  for (const int v : face_a.vertices) middle_a += a->vertices()[v] / static_cast<double>(face_a.vertices.size());
  for (const int v : face_b.vertices) middle_b += b->vertices()[v] / static_cast<double>(face_b.vertices.size());
  pair.at_b.position = pair.at_a.orientation * middle_a - pair.at_b.orientation * middle_b + beside - depth * up;
  return pair;
}

template <class Visit>
void for_each_pair(const Visit& visit) {
  for (std::size_t i = 0; i < others().size(); ++i) {
    for (std::size_t j = i; j < others().size(); ++j) visit(others()[i], others()[j]);
  }
}

TEST(OtherSolids, AreRightWhereFacesMeet) {
  RandomStream random{72};
  std::vector<double> errors;
  int clipped = 0;
  for_each_pair([&](const Solid& a, const Solid& b) {
    for (double depth = 1e-4; depth > 5e-13; depth /= 10) {
      const Placed pair = flat_contact(a, b, depth, depth * random.uniform(), random);
      OverlapHessian unused;
      clipped += found(pair, unused).path == OverlapPath::clip;
      const double here = error(pair);
      EXPECT_LE(here, 1e-13) << to_string(a) << " " << to_string(b) << " depth " << depth;
      errors.push_back(here);
    }
  });
  std::sort(errors.begin(), errors.end());
  const double middle = errors[errors.size() / 2];
  std::printf("%zu flat contacts: %.1e at worst, %.1e in the middle, %d of them clipped\n", errors.size(),
              errors.back(), middle, clipped);
  EXPECT_LE(middle, 1e-15);
  EXPECT_LT(clipped, static_cast<int>(errors.size()) / 50);
}

/// Centres moved together or apart along a line until V is what is asked; nullopt where it comes with a step.
std::optional<Placed> at_volume(Placed pair, const Vector3d& direction, double volume) {
  double near = 0, far = pair.a.circumradius() + pair.b.circumradius();
  for (int k = 0; k < 90; ++k) {
    const double middle = (near + far) / 2;
    pair.at_b.position = middle * direction;
    (exact(pair).volume > volume ? near : far) = middle;
  }
  pair.at_b.position = near * direction;
  const double reached = static_cast<double>(exact(pair).volume);
  return reached > volume / 2 && reached < 2 * volume ? std::optional(pair) : std::nullopt;
}

TEST(OtherSolids, AreRightWhereCornersAndEdgesMeet) {
  RandomStream random{73};
  double worst = 0;
  int pairs = 0, skipped = 0;
  for_each_pair([&](const Solid& a, const Solid& b) {
    for (const double volume : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      Placed pair{*a, *b, {}, {}};
      pair.at_a.orientation = random_orientation(random), pair.at_b.orientation = random_orientation(random);
      const auto touching = at_volume(pair, random_direction(random), volume);
      if (!touching) ++skipped;
      if (!touching) continue;
      ++pairs;
      const double here = error(*touching);
      EXPECT_LE(here, 1e-12) << to_string(a) << " " << to_string(b) << " V " << volume;
      worst = std::max(worst, here);
    }
  });
  std::printf("%d pointed contacts: %.1e at worst, %d not made\n", pairs, worst, skipped);
  EXPECT_GT(pairs, 150);
}

TEST(OtherSolids, HaveTheHessiansOfDifferences) {
  RandomStream random{74};
  double worst = 0;
  for_each_pair([&](const Solid& a, const Solid& b) {
    Placed pair{*a, *b, {}, {}};
    pair.at_a.orientation = random_orientation(random), pair.at_b.orientation = random_orientation(random);
    const auto touching = at_volume(pair, random_direction(random), 1e-3);
    if (!touching) return;
    OverlapHessian hessian;
    ASSERT_EQ(found(*touching, hessian).path, OverlapPath::loop);
    const double h = 1e-7;
    for (int c = 0; c < 3; ++c) {
      // ∂S_A/∂x_B is the upper left block of H_AB.
      Placed up = *touching, down = *touching;
      up.at_b.position[c] += h, down.at_b.position[c] -= h;
      const double step = up.at_b.position[c] - down.at_b.position[c];
      const Vector3d slope = rounded(exact(up).area - exact(down).area) / step;
      const double here =
          (slope - hessian.ab.topLeftCorner<3, 3>().col(c)).norm() / hessian.ab.topLeftCorner<3, 3>().norm();
      EXPECT_LE(here, 1e-8) << to_string(a) << " " << to_string(b) << " column " << c;
      worst = std::max(worst, here);
    }
  });
  std::printf("slopes of S: %.1e at worst\n", worst);
}

TEST(OtherSolids, AreRightWhereTheyCoincide) {
  double worst = 0;
  for (const Solid& solid : others()) {
    Placed same{*solid, *solid, {}, {}};
    OverlapHessian unused;
    EXPECT_NEAR(found(same, unused).volume, 1, 1e-14) << to_string(solid);
    // Along an edge, faces slide in themselves; by twice the distance of a face, they touch without a depth.
    const Edge& edge = solid->edges().front();
    same.at_b.position = .3 * (solid->vertices()[edge.head] - solid->vertices()[edge.tail]);
    const double here = error(same);
    EXPECT_LE(here, 1e-14) << to_string(solid);
    worst = std::max(worst, here);
  }
  std::printf("faces in each other: %.1e at worst\n", worst);
}

}  // namespace
}  // namespace isojam
