#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/geometry/quad.hpp"

namespace isojam {

/// Names of the solids that are built in, without prisms and antiprisms: the Platonic solids in the order of
/// all_solids, then others.
std::span<const std::string_view> named_solids();

/// Names of the prisms and antiprisms, for messages.
inline constexpr std::string_view prism_names = "prism3 to prism21 and antiprism4 to antiprism16";

/// Vertices of a built-in solid, in arbitrary units; nullopt for an unknown name. All edges of a solid have the same
/// length. The base of prism6 and antiprism6 is a regular hexagon. prism4 and antiprism3 do not exist: they are the
/// cube and the octahedron.
std::optional<std::vector<Quad3>> named_vertices(std::string_view name);

}  // namespace isojam
