#pragma once

#include "engine/geometry/hull.hpp"
#include "engine/geometry/solids/solid.hpp"
#include "tasks/io/place.hpp"

namespace isojam {

/// Writes "solid", the name of the solid. For a user-defined solid, it also writes "vertices" as the user gave them,
/// from which the solid is reproduced with all bits.
void put_solid(Json& json, const Solid& solid);

/// Reads what put_solid() has written to the object at `place`. Throws InputError if the name is unknown, or if the
/// vertices do not form a solid.
Solid read_solid(const JsonPlace& place);

/// Reads a list of vertices with three numbers each.
std::vector<Eigen::Vector3d> read_vertices(const JsonPlace& place);
/// Makes the solid with this name and these vertices. `place` is the list of the vertices. An error that one vertex
/// causes is reported at this vertex.
Solid solid_from(const JsonPlace& place, const std::string& name, const std::vector<Eigen::Vector3d>& vertices);

/// Makes the same solid, but throws NoSolid instead of InputError if the vertices form no solid.
Solid made_solid(const JsonPlace& place, const std::string& name, const std::vector<Eigen::Vector3d>& vertices);
/// The place of the vertex that causes `error`. It is the place `vertices` if no single vertex causes the error. It is
/// also this place if `vertices` is not a list of all `points` vertices: the corners of a box are not in the document.
JsonPlace place_of_error(const JsonPlace& vertices, const NoSolid& error, std::size_t points);

/// The allowed numbers of features of a solid, as text for messages.
std::string allowed_features();

/// Names of the built-in solids, as text for messages.
std::string allowed_solids();

}  // namespace isojam
