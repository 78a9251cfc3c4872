#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/geometry/repair.hpp"
#include "engine/packing/mixture/mixture.hpp"
#include "tasks/packings/solid_json.hpp"

namespace isojam {

inline constexpr std::size_t longest_solid_name = 48;  ///< largest number of characters in the name of a solid
inline constexpr std::string_view solid_name_pattern = "^[A-Za-z][A-Za-z0-9_]{0,47}$";

/// A solid that a document defines.
struct SolidDefinition {
  Solid solid;
  RepairReport report{};               ///< the repairs that were made; the document allowed them
  std::vector<std::string> omitted{};  ///< parts of the file that do not belong to the solid
};

/// The solids that a document defines, with their names as keys.
using SolidDefinitions = std::map<std::string, SolidDefinition, std::less<>>;

/// Reads an object: {"brick": {"box": [1, 1.5, 2]}, "rock": {"file": "rock.off"}, "mine": {"vertices": [[…], …]}}. A
/// file or a list of vertices may have the keys of RepairOptions. Paths are relative to the document. Any unit of
/// length is allowed, because every solid is scaled to unit volume. Throws InputError if a name is invalid or is that
/// of a built-in solid, or if a solid is not convex.
SolidDefinitions read_definitions(const JsonPlace& place);
/// The schemas of what read_definitions() and read_solid_name() accept.
Json definitions_schema();
Json solid_schema();

/// Reads the name of a solid at `place` and returns the solid. It is a built-in solid, or a solid that the document
/// defines.
Solid read_solid_name(const JsonPlace& place, const SolidDefinitions& definitions);

/// Throws InputError if a name is invalid. The name of a solid becomes a part of file names and of the names of
/// replicates.
void check_solid_name(const JsonPlace& place, const std::string& name);

/// A line of text with the features of a solid, the precision of its vertices, and the repairs.
std::string definition_text(const SolidDefinition& definition);

/// Warning about a solid with faces that are almost in one plane: its vertices were probably written with too few
/// digits. The text names these faces and the value of RepairOptions::merge that joins them. Empty if no faces are
/// almost in one plane.
std::string precision_warning(const Solid& solid);

/// The relative changes of the volumes of a mixture's solids by repairs, by names. Other solids are left out.
std::map<std::string, double> volume_changes(const Mixture& mixture, const SolidDefinitions& definitions);

/// Definitions of the user-defined solids of mixtures by their vertices, as JSON. null if there are none.
Json definitions_json(const std::vector<Mixture>& mixtures, const SolidDefinitions& definitions);

}  // namespace isojam
