#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/names/enum_names.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/io/place.hpp"

namespace isojam {

/// The object of the manifest that contains a parameter.
enum class Group { protocol, minimiser };
template <>
inline constexpr std::array enum_names<Group>{EnumName{Group::protocol, "protocol"},
                                              EnumName{Group::minimiser, "minimiser"}};

using Slot = std::variant<double*, int*, long*, bool*, Method*, Consolidation*, Control*, CellShape*>;

/// A parameter of the engine that a manifest may set or sweep. Its default is the default of the member of the engine's
/// options.
struct Field {
  std::string_view name;  ///< name, which is unique over both groups
  Group group;
  Slot (*slot)(JamOptions&);
  Range range;  ///< allowed values of a number
};

/// All parameters: first those of the protocol, then those of the minimiser, in the order of manifests and records.
std::span<const Field> all_fields();
const Field* find_field(std::string_view name);

/// Present name of a key that had another name in an earlier version. Empty if there was no such key.
std::string_view new_name(std::string_view name);

/// Text that describes the allowed values, such as "a number in (0, 1]".
std::string allowed_values(const Field& field);

/// Reads the value of a field. Throws InputError unless the value has the type of the field and is within its range.
void read_field(const JsonPlace& place, const Field& field, JamOptions& options);
Json field_value(const Field& field, JamOptions options);

/// All fields of a group as a JSON object.
Json group_values(Group group, const JamOptions& options);

}  // namespace isojam
