#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/names/enum_names.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

/// The object of the manifest that contains a parameter.
enum class Group { protocol, minimiser };
template <>
inline constexpr std::array enum_names<Group>{EnumName{Group::protocol, "protocol"},
                                              EnumName{Group::minimiser, "minimiser"}};

using Slot = std::variant<double*, int*, long*, bool*, Method*, Consolidation*, Control*, CellShape*>;

/// A parameter of the engine that a manifest may set or sweep. Its default is the in-class default of the struct.
struct Field {
  std::string_view name;  ///< unique over both groups
  Group group;
  Slot (*slot)(JamOptions&);
  Range range;  ///< for numeric fields
};

/// Every parameter: first the protocol's, then the minimiser's, each in the order of its struct.
std::span<const Field> all_fields();
const Field* find_field(std::string_view name);

/// Present name of a key of an earlier version; empty if it was no such key.
std::string_view new_name(std::string_view name);

/// "a number in (0, 1]" and so on.
std::string allowed_values(const Field& field);

/// Throws InputError unless the value is of the field's type and within its range.
void read_field(const JsonPlace& place, const Field& field, JamOptions& options);
Json field_value(const Field& field, JamOptions options);

/// The fields of a group as an object.
Json group_values(Group group, const JamOptions& options);

}  // namespace isojam
