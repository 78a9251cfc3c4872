#include "tests/engine/geometry/overlap/exact_pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/engine/geometry/overlap/pairs.hpp"

namespace isojam::testing_pairs {

using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

DoubleDoubleVector narrow(const Quad3& p) {
  DoubleDoubleVector result;
  for (int c = 0; c < 3; ++c) result.set(c, narrowed(p[static_cast<std::size_t>(c)]));
  return result;
}

template <class T>
const T& pick(const std::vector<T>& list, RandomStream& random) {
  return list[static_cast<std::size_t>(random.uniform() * static_cast<double>(list.size()))];
}

Vector3d vertex(const ConvexSolid& solid, int v) { return solid.vertices()[static_cast<std::size_t>(v)]; }

Vector3d middle_of(const ConvexSolid& solid, const Face& face) {
  Vector3d middle = Vector3d::Zero();
  for (const int v : face.vertices) middle += vertex(solid, v) / static_cast<double>(face.vertices.size());
  return middle;
}

/// Smallest distance of an edge from the middle of the face.
double radius_of(const ConvexSolid& solid, const Face& face) {
  const Vector3d middle = middle_of(solid, face);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < face.vertices.size(); ++k) {
    const Vector3d tail = vertex(solid, face.vertices[k]);
    const Vector3d along = (vertex(solid, face.vertices[(k + 1) % face.vertices.size()]) - tail).normalized();
    least = std::min(least, along.cross(middle - tail).norm());
  }
  return least;
}

/// Places the point `of_b` of B opposite the point `on` of A. `outward` is the outward direction of B at its point, in
/// B's frame; `up` is that of A at its point.
Approach facing(const ConvexSolid& a, const ConvexSolid& b, const Vector3d& on, const Vector3d& up,
                const Vector3d& of_b, const Vector3d& outward, RandomStream& random) {
  Approach result{{a, b, {}, {}}, {}, {}};
  PosedPair& pair = result.pair;
  pair.at_a.orientation = random_orientation(random);
  result.outward = pair.at_a.orientation * up;
  const Quaterniond about(Eigen::AngleAxisd(6.28 * random.uniform(), result.outward));
  pair.at_b.orientation = (about * Quaterniond::FromTwoVectors(outward, -result.outward)).normalized();
  result.from = pair.at_a.orientation * on - pair.at_b.orientation * of_b;
  return result;
}

struct Ridge {
  Vector3d middle, outward;
};

Ridge ridge_of(const ConvexSolid& solid, const Edge& edge) {
  const auto normal = [&](int face) { return solid.faces()[static_cast<std::size_t>(face)].normal; };
  return {(vertex(solid, edge.tail) + vertex(solid, edge.head)) / 2,
          (normal(edge.left) + normal(edge.right)).normalized()};
}

}  // namespace

Quad3 displacement(const PosedPair& pair) { return quad_position(pair.at_b) - quad_position(pair.at_a); }

QuadOverlap exact(const PosedPair& pair) {
  QuadOverlap result = clipped_overlap(pair.a, pair.b, relative_pose(pair.at_a, pair.at_b, displacement(pair)));
  result.area = quad_rotation(pair.at_a) * result.area;
  result.moment = quad_rotation(pair.at_a) * result.moment;
  return result;
}

Overlap found(const PosedPair& pair, OverlapHessian& hessian) {
  SeparatingAxis axis;
  return overlap_with_hessian(LonePlacedSolid(pair.a, rotation_matrix(pair.at_a)),
                              LonePlacedSolid(pair.b, rotation_matrix(pair.at_b)), narrow(displacement(pair)), axis,
                              hessian);
}

Overlap found(const PosedPair& pair) {
  OverlapHessian unused;
  return found(pair, unused);
}

double error(const PosedPair& pair) { return error(pair, exact(pair), found(pair)); }

double error(const PosedPair& pair, const QuadOverlap& right, const Overlap& got) {
  const double volume = static_cast<double>(right.volume), area = static_cast<double>(norm(right.area));
  const auto off = [](const Quad3& p, const Vector3d& q) {
    return static_cast<double>(norm(p - Quad3{q.x(), q.y(), q.z()}));
  };
  return std::max({std::abs(static_cast<double>(Quad(got.volume) - right.volume)) / volume,
                   off(right.area, got.area) / area, off(right.moment, got.moment) / (area * pair.a.inradius())});
}

double hessian_error(const PosedPair& pair) {
  OverlapHessian hessian;
  if (found(pair, hessian).path != OverlapPath::loop) return std::numeric_limits<double>::infinity();
  const Eigen::Matrix3d block = hessian.ab.topLeftCorner<3, 3>();
  const double h = 1e-7;
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    PosedPair up = pair, down = pair;
    up.at_b.position[c] += h, down.at_b.position[c] -= h;
    const double step = up.at_b.position[c] - down.at_b.position[c];
    const Vector3d slope = rounded(exact(up).area - exact(down).area) / step;
    worst = std::max(worst, (slope - block.col(c)).norm() / block.norm());
  }
  return worst;
}

PosedPair flat_contact(const ConvexSolid& a, const ConvexSolid& b, double depth, double tilt, RandomStream& random) {
  const Face &face_a = pick(a.faces(), random), &face_b = pick(b.faces(), random);
  const Approach flush = facing(a, b, middle_of(a, face_a), face_a.normal, middle_of(b, face_b), face_b.normal, random);
  PosedPair pair = flush.pair;
  const Quaterniond tilted(Eigen::AngleAxisd(tilt, flush.outward.unitOrthogonal()));
  pair.at_b.orientation = (tilted * pair.at_b.orientation).normalized();
  Vector3d beside = std::min(radius_of(a, face_a), radius_of(b, face_b)) / 3 * random_direction(random);
  beside -= beside.dot(flush.outward) * flush.outward;
  pair.at_b.position = pair.at_a.orientation * middle_of(a, face_a) - pair.at_b.orientation * middle_of(b, face_b) +
                       beside - depth * flush.outward;
  return pair;
}

Approach random_approach(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random) {
  Approach result{{a, b, {}, {}}, Vector3d::Zero(), {}};
  result.pair.at_a.orientation = random_orientation(random);
  result.pair.at_b.orientation = random_orientation(random);
  result.outward = random_direction(random);
  return result;
}

Approach corner_over_face(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random) {
  const Face& face = pick(a.faces(), random);
  const Vector3d& corner = pick(b.vertices(), random);
  return facing(a, b, middle_of(a, face), face.normal, corner, corner.normalized(), random);
}

Approach edge_over_edge(const ConvexSolid& a, const ConvexSolid& b, RandomStream& random) {
  const Ridge of_a = ridge_of(a, pick(a.edges(), random)), of_b = ridge_of(b, pick(b.edges(), random));
  return facing(a, b, of_a.middle, of_a.outward, of_b.middle, of_b.outward, random);
}

Approach edge_in_face(const ConvexSolid& a, const ConvexSolid& b, double tilt, RandomStream& random) {
  const Face& face = pick(a.faces(), random);
  const Edge& edge = pick(b.edges(), random);
  const Ridge ridge = ridge_of(b, edge);
  Approach result = facing(a, b, middle_of(a, face), face.normal, ridge.middle, ridge.outward, random);
  const Vector3d along = result.pair.at_b.orientation * (vertex(b, edge.head) - vertex(b, edge.tail)).normalized();
  const Quaterniond tilted(Eigen::AngleAxisd(tilt, result.outward.cross(along)));
  result.pair.at_b.orientation = (tilted * result.pair.at_b.orientation).normalized();
  result.from = result.pair.at_a.orientation * middle_of(a, face) - result.pair.at_b.orientation * ridge.middle;
  return result;
}

std::optional<PosedPair> at_volume(Approach approach, double volume) {
  PosedPair& pair = approach.pair;
  // At the displacement `from`, or deeper by the size of the smaller solid, V is larger than `volume`.
  double far = pair.a.circumradius() + pair.b.circumradius();
  double near = -std::min(approach.from.norm(), std::min(pair.a.inradius(), pair.b.inradius()));
  for (int k = 0; k < 90; ++k) {
    const double middle = (near + far) / 2;
    pair.at_b.position = approach.from + middle * approach.outward;
    const double reached = found(pair).volume;
    if (reached > volume / 2 && reached < 2 * volume) return pair;
    (reached > volume ? near : far) = middle;
  }
  return std::nullopt;
}

ConvexSolid dual(const std::string& name, const ConvexSolid& solid) {
  std::vector<Quad3> points;
  for (int f = 0; f < solid.arrays().faces; ++f)
    points.push_back((1 / solid.arrays().plane_offset(f)) * solid.arrays().normal(f));
  return ConvexSolid(name, points);
}

std::vector<Vector3d> points_on_sphere(int n, std::uint64_t seed) {
  RandomStream random{seed};
  std::vector<Vector3d> points;
  for (int k = 0; k < n; ++k) points.push_back(random_direction(random));
  return points;
}

}  // namespace isojam::testing_pairs
