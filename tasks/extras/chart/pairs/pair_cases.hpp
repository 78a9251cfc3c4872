#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/names/enum_names.hpp"

namespace isojam::oracle {

/// Classes of pairs that are difficult for an overlap algorithm for different reasons.
enum class PairClass {
  random_contact,       ///< random orientation and direction
  near_parallel_faces,  ///< two faces in contact, tilted by 1e-10..1e-2
  edge_in_face,         ///< an edge in a face, tilted by 0 or 1e-16..1e-2
  parallel_edges,       ///< two edges in contact, parallel within rounding errors
  vertex_vertex,        ///< two vertices in contact on a common axis
  same_orientation,     ///< equal orientation up to a symmetry of the solid, with any displacement
  coplanar_faces,       ///< equal orientation, displaced so that faces are coplanar, exactly or within rounding errors
  coincident,           ///< equal position and orientation up to a symmetry, exactly or within rounding errors
  near_coincident,      ///< nearly equal position and orientation, displaced and rotated by 1e-16..1e-8
};

}  // namespace isojam::oracle

namespace isojam {

template <>
inline constexpr std::array enum_names<oracle::PairClass>{
    EnumName{oracle::PairClass::random_contact, "random"},
    EnumName{oracle::PairClass::near_parallel_faces, "near-parallel faces"},
    EnumName{oracle::PairClass::edge_in_face, "edge in face"},
    EnumName{oracle::PairClass::parallel_edges, "parallel edges"},
    EnumName{oracle::PairClass::vertex_vertex, "vertex-vertex"},
    EnumName{oracle::PairClass::same_orientation, "same orientation"},
    EnumName{oracle::PairClass::coplanar_faces, "coplanar faces"},
    EnumName{oracle::PairClass::coincident, "coincident"},
    EnumName{oracle::PairClass::near_coincident, "near-coincident"}};

}  // namespace isojam

namespace isojam::oracle {

inline constexpr auto all_pair_classes = all_of<PairClass>;

/// Range of V/V_p for the first five classes, which are contacts. The logarithm is uniformly distributed.
inline constexpr double least_contact_volume = 1e-5, greatest_contact_volume = 3e-2;

// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): A and B first reads best, and there are few of them
struct PairCase {
  SolidKind a, b;
  Eigen::Quaterniond quaternion;  ///< quaternion of any length
  Eigen::Vector3d displacement;
};

/// The first `count` pairs of a class. They depend only on the arguments, because the seed is fixed.
std::vector<PairCase> pair_cases(SolidKind a, SolidKind b, PairClass pair_class, int count);

/// Volume of the intersection by clipping in double precision. Use it to construct pairs, not to check results.
double rough_volume(const PairCase& pair);

}  // namespace isojam::oracle
