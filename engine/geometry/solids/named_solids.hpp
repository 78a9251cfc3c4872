#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// Names of the built-in solids except prisms and antiprisms. The Platonic solids come first, in the order of
/// all_solids.
std::span<const std::string_view> named_solids();

/// Names of the prisms and antiprisms, as text for messages.
inline constexpr std::string_view prism_names = "prism3, prism5 to prism64, antiprism4 to antiprism48";

/// Vertices of a built-in solid, in arbitrary units, or nullopt for an unknown name. All edges of a solid have the same
/// length. The number in the name of a prism or antiprism is the number of sides of its two bases. For example, the
/// bases of prism6 and antiprism6 are regular hexagons. The names prism4 and antiprism3 do not exist, because these
/// solids are the cube and the octahedron.
std::optional<std::vector<Quad3>> named_vertices(std::string_view name);

}  // namespace isojam
