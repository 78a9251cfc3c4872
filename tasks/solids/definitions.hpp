#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tasks/solids/solid_json.hpp"

namespace isojam {

/// The solids that a document defines, by name.
using SolidDefinitions = std::map<std::string, Solid, std::less<>>;

/// An object: {"brick": {"box": [1, 1.5, 2]}, "rock": {"file": "rock.off"}, "mine": {"vertices": [[…], …]}}; a file's
/// path is relative to the document's. Units do not matter: every solid is scaled to unit volume. Throws InputError for
/// a name that is taken or no name, and for what is no convex solid.
SolidDefinitions read_definitions(const JsonPlace& place);

/// The solid of the name at `place`: one of the document's, or one with a name of its own.
Solid read_solid_name(const JsonPlace& place, const SolidDefinitions& definitions);

/// Refuses what cannot be the name of a solid: a name stands in names of files, and between others in the names of
/// replicates.
void check_solid_name(const JsonPlace& place, const std::string& name);

/// Definitions by vertices of those that need one; null if none does.
Json definitions_json(const std::vector<Solid>& solids);

}  // namespace isojam
