#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/geometry/pose.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam {

/// Classes of pairs of solids. Each is difficult for an overlap algorithm, for a different reason.
enum class PairClass {
  random_contact,       ///< random orientation, displaced in a random direction
  near_parallel_faces,  ///< two faces in contact; the angle between them is 1e-10 to 1e-2
  edge_in_face,         ///< an edge in contact with a face; the angle between them is 0, or 1e-16 to 1e-2
  parallel_edges,       ///< two edges in contact that are parallel within rounding errors
  vertex_vertex,        ///< two vertices in contact; both are on a line through the two centres
  same_orientation,     ///< equal orientation up to a symmetry of the solid, displaced in a random direction
  /// equal orientation up to a symmetry, displaced so that faces are coplanar, exactly or within rounding errors
  coplanar_faces,
  coincident,  ///< equal position, and equal orientation up to a symmetry, exactly or within rounding errors
  /// nearly equal position and orientation: the displacement and the rotation are 0, or 1e-16 to 1e-8
  near_coincident,
};

template <>
inline constexpr std::array enum_names<PairClass>{EnumName{PairClass::random_contact, "random"},
                                                  EnumName{PairClass::near_parallel_faces, "near-parallel faces"},
                                                  EnumName{PairClass::edge_in_face, "edge in face"},
                                                  EnumName{PairClass::parallel_edges, "parallel edges"},
                                                  EnumName{PairClass::vertex_vertex, "vertex-vertex"},
                                                  EnumName{PairClass::same_orientation, "same orientation"},
                                                  EnumName{PairClass::coplanar_faces, "coplanar faces"},
                                                  EnumName{PairClass::coincident, "coincident"},
                                                  EnumName{PairClass::near_coincident, "near-coincident"}};

inline constexpr auto all_pair_classes = all_of<PairClass>;

/// Range of V/V_p of the first five classes; its logarithm is uniformly distributed in this range.
inline constexpr double least_contact_volume = 1e-5, greatest_contact_volume = 3e-2;

// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): A and B first reads best, and there are few of them
/// A pair of solids: A is at the origin and not rotated, B is rotated and displaced.
struct PairCase {
  SolidKind a, b;
  Eigen::Quaterniond quaternion;  ///< rotation of B; the quaternion may have any length
  Eigen::Vector3d displacement;

  /// The pose of B.
  Pose pose() const {
    Pose pose;
    pose.position = displacement;
    pose.orientation = quaternion;
    return pose;
  }
};

/// The first `count` pairs of a class. Equal arguments give equal pairs, because the seed is fixed.
std::vector<PairCase> pair_cases(SolidKind a, SolidKind b, PairClass pair_class, int count);

}  // namespace isojam
