#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tasks/solids/solid_json.hpp"

namespace isojam {

/// The solids that a document defines, by name.
using SolidDefinitions = std::map<std::string, Solid, std::less<>>;

/// Reads an object: {"brick": {"box": [1, 1.5, 2]}, "rock": {"file": "rock.off"}, "mine": {"vertices": [[…], …]}}.
/// Paths are relative to the document. Units do not matter, because every solid is scaled to unit volume. Throws
/// InputError for a name that is taken or invalid, and for a solid that is not convex.
SolidDefinitions read_definitions(const JsonPlace& place);

/// The solid of the name at `place`: a built-in solid or one defined in the document.
Solid read_solid_name(const JsonPlace& place, const SolidDefinitions& definitions);

/// Refuses invalid names. A solid's name becomes part of file names and of the names of replicates.
void check_solid_name(const JsonPlace& place, const std::string& name);

/// Definitions of user-defined solids by vertices; null if there are none.
Json definitions_json(const std::vector<Solid>& solids);

}  // namespace isojam
