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

/// Kinds of relative position that strain an overlap algorithm in different ways.
enum class PairClass {
  random_contact,       ///< any orientation and direction
  near_parallel_faces,  ///< face against face, tilted by 1e-10..1e-2
  edge_in_face,         ///< an edge inside a face, tilted by 0 or 1e-16..1e-2
  parallel_edges,       ///< edge against edge, parallel to rounding
  vertex_vertex,        ///< vertex against vertex on a common axis
  same_orientation,     ///< equal orientation up to a symmetry of the solid, any displacement
  coplanar_faces,       ///< the same, displaced within a face plane: exactly, or to rounding
  coincident,           ///< one upon the other up to a symmetry, exactly or to rounding
  near_coincident,      ///< the same, displaced and rotated by 1e-16..1e-8
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

/// Contacts (the first five classes) have V/V_p in this range, log-uniform.
inline constexpr double least_contact_volume = 1e-5, greatest_contact_volume = 3e-2;

// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): A and B first reads best, and there are few of them
struct PairCase {
  SolidKind a, b;
  Eigen::Quaterniond quaternion;  ///< of any length
  Eigen::Vector3d displacement;
};

/// The first `count` pairs of a class: a function of the arguments alone (fixed seed).
std::vector<PairCase> pair_cases(SolidKind a, SolidKind b, PairClass pair_class, int count);

/// Intersection volume by clipping in double: for construction, not for checking.
double rough_volume(const PairCase& pair);

}  // namespace isojam::oracle
