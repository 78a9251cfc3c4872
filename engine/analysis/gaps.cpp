#include "engine/analysis/gaps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/overlap/separating_axis.hpp"
#include "engine/packing/pair_loop.hpp"
#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

/// True if two planes parallel to a face of A or B separate the particles and have at least this distance.
bool faces_reach(const ConvexSolid& a, const ConvexSolid& b, const RelativePose& pose, double distance) {
  const auto reaches = [&](SeparatingAxis::Kind kind, std::size_t face) {
    const auto index = static_cast<std::uint8_t>(face);
    return gap(a, b, pose, {kind, index, index}) >= distance;
  };
  for (std::size_t f = 0; f < a.faces().size(); ++f) {
    if (reaches(SeparatingAxis::Kind::face_a, f)) return true;
  }
  for (std::size_t f = 0; f < b.faces().size(); ++f) {
    if (reaches(SeparatingAxis::Kind::face_b, f)) return true;
  }
  return false;
}

/// Largest gap of the circumscribed spheres of two particles whose width is at most `max_width`. Let C be the Minkowski
/// difference of A and B. The faces of C are among the candidate planes. Their distances from the centre are at least
/// r_A + r_B, the sum of the inradii. If the width is at most w, the vector x_B − x_A is inside all planes of C after
/// they have moved outwards by w, and so inside C scaled by 1 + w/(r_A + r_B). The most distant point of C is at most
/// at R_A + R_B, the sum of the circumradii. The gap of the spheres is therefore at most w (R_A + R_B)/(r_A + r_B),
/// which is at most w times the largest R/r of a particle.
double sphere_gap_limit(const Packing& packing, double max_width) {
  constexpr double rounding = 1e-9;
  double largest_ratio = 1;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const ConvexSolid& solid = packing.solids[i];
    largest_ratio = std::max(largest_ratio, solid.circumradius() / solid.inradius());
  }
  return max_width * largest_ratio * (1 + rounding);
}

/// Direction of a separating axis in the body frame of A, from A to B.
Eigen::Vector3d direction_of(const SeparatingAxis& axis, const ConvexSolid& a, const ConvexSolid& b,
                             const RelativePose& pose) {
  if (axis.kind == SeparatingAxis::Kind::face_a) return a.faces()[axis.a].normal;
  if (axis.kind == SeparatingAxis::Kind::face_b) return -(pose.rotation * b.faces()[axis.b].normal);
  const auto along = [](const ConvexSolid& solid, std::size_t k) -> Eigen::Vector3d {
    const Edge& edge = solid.edges()[k];
    return solid.vertices()[static_cast<std::size_t>(edge.head)] -
           solid.vertices()[static_cast<std::size_t>(edge.tail)];
  };
  const Eigen::Vector3d normal = along(a, axis.a).cross(pose.rotation * along(b, axis.b)).normalized();
  return normal.dot(pose.displacement) < 0 ? Eigen::Vector3d(-normal) : normal;
}

}  // namespace

std::vector<Gap> near_gaps(const Packing& packing, double max_width) {
  if (!(max_width > 0)) throw std::invalid_argument("the largest gap must be positive");
  const auto pairs = find_in_reach(packing, sphere_gap_limit(packing, max_width));
  PlacedSolids placed;
  place_all(packing, Precision::working, placed);
  std::vector<Gap> all(pairs.size());
  for_each_small(pairs.size(), [&](std::size_t k) {
    const PlacedSolid a = placed[static_cast<std::size_t>(pairs[k].a)],
                      b = placed[static_cast<std::size_t>(pairs[k].b)];
    const Eigen::Matrix3d to_a = a.rotation().transpose();
    const RelativePose pose{to_a * b.rotation(), to_a * displacement(packing, pairs[k])};
    // Most candidates are too far apart. The faces show this faster than the pairs of edges.
    if (faces_reach(a.solid(), b.solid(), pose, max_width)) return;
    const auto axis = best_axis(a.solid(), b.solid(), pose);
    const double width = gap(a.solid(), b.solid(), pose, axis);
    if (!(width > 0 && width < max_width)) return;
    // A product of two edges can have the same planes as a face. Then the planes are parallel to this face.
    all[k] = {pairs[k], width,
              faces_reach(a.solid(), b.solid(), pose, width - gap_tolerance(a.solid(), b.solid(), pose)), pose,
              direction_of(axis, a.solid(), b.solid(), pose)};
  });
  std::vector<Gap> gaps;
  for (const Gap& gap : all) {
    if (gap.width > 0) gaps.push_back(gap);
  }
  return gaps;
}

Contact as_contact(const Packing& packing, const Gap& gap, double reach) {
  RelativePose moved = gap.pose;
  moved.displacement -= reach * gap.axis;
  return {gap.pair, displacement(packing, gap.pair), gap.pose,
          relative_overlap(packing.solids[static_cast<std::size_t>(gap.pair.a)],
                           packing.solids[static_cast<std::size_t>(gap.pair.b)], moved)};
}

}  // namespace isojam
