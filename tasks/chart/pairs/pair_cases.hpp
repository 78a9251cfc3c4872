#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/geometry/convex_solid.hpp"

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
  near_coincident,      ///< the same, displaced and turned by 1e-16..1e-8
};

inline constexpr std::array all_pair_classes{
    PairClass::random_contact, PairClass::near_parallel_faces, PairClass::edge_in_face,
    PairClass::parallel_edges, PairClass::vertex_vertex,       PairClass::same_orientation,
    PairClass::coplanar_faces, PairClass::coincident,          PairClass::near_coincident};

std::string_view to_string(PairClass pair_class);

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

/// Intersection volume by clipping in double: for aiming, not for checking.
double rough_volume(const PairCase& pair);

}  // namespace isojam::oracle
