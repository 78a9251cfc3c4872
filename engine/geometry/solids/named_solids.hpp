#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// Names of solids that need no definition, but for prisms and antiprisms: the Platonic solids in the order of
/// all_solids, then others.
std::span<const std::string_view> named_solids();

/// What the names of prisms and antiprisms look like, for messages.
inline constexpr std::string_view prism_names = "prism3 to prism21 and antiprism4 to antiprism16";

/// Vertices of a solid with a name of its own, in any units; nullopt for other names. All of its edges are of one
/// length, those of prisms and antiprisms with a regular polygon of n sides for a base included (prism6, antiprism5);
/// prism4 and antiprism3 are the cube and the octahedron, and have no other name.
std::optional<std::vector<Quad3>> named_vertices(std::string_view name);

}  // namespace isojam
