#pragma once

#include "engine/geometry/solids/solid.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

/// Writes "solid", its name, and for a user-defined solid "vertices" as they were given, from which it is restored bit
/// for bit.
void put_solid(Json& json, const Solid& solid);

/// Reads the output of put_solid from the object at `place`. Throws InputError for an unknown name and for vertices
/// that form no solid.
Solid read_solid(const JsonPlace& place);

/// A list of vertices, three numbers each.
std::vector<Eigen::Vector3d> read_vertices(const JsonPlace& place);
/// The solid of that name with vertices from `place`. An error caused by one vertex is reported at that vertex.
Solid solid_from(const JsonPlace& place, const std::string& name, const std::vector<Eigen::Vector3d>& vertices);

/// Names of built-in solids, for messages.
std::string allowed_solids();

}  // namespace isojam
