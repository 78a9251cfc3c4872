#pragma once

#include "engine/geometry/solids/solid.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

/// Writes "solid", its name, and of a solid that was defined "vertices" as they were given, from which it comes again
/// bit for bit.
void put_solid(Json& json, const Solid& solid);

/// Reads what put_solid wrote from the object at `place`. Throws InputError for a name that no solid has and vertices
/// of none.
Solid read_solid(const JsonPlace& place);

/// A list of vertices, three numbers each.
std::vector<Eigen::Vector3d> read_vertices(const JsonPlace& place);
/// The solid of that name with vertices from `place`; an error that one of them makes is told there.
Solid solid_from(const JsonPlace& place, const std::string& name, const std::vector<Eigen::Vector3d>& vertices);

/// Names of solids that need no definition, for messages.
std::string allowed_solids();

}  // namespace isojam
