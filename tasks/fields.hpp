#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/solve/jam.hpp"
#include "tasks/json_place.hpp"

namespace isojam {

/// The object of the manifest in which a parameter stands.
enum class Group { protocol, minimiser };
std::string_view to_string(Group group);

using Slot = std::variant<double*, int*, long*, bool*, Method*>;

/// A parameter of the engine that a manifest may set or sweep. Its default is the in-class default of the struct.
struct Field {
  std::string_view name;  ///< unique over both groups
  Group group;
  Slot (*slot)(JamOptions&);
  Range range;  ///< of the numeric ones
};

/// Every parameter, the protocol's first, each group in the order of its struct.
std::span<const Field> all_fields();
const Field* find_field(std::string_view name);

/// Names of the minimisers, in the order of the enum.
std::span<const std::string_view> method_names();

/// "a number in (0, 1]" and so on.
std::string allowed_values(const Field& field);

/// Throws InputError unless the value is of the field's type and within its range.
void read_field(const JsonPlace& place, const Field& field, JamOptions& options);
Json field_value(const Field& field, JamOptions options);

/// The fields of a group as an object.
Json group_values(Group group, const JamOptions& options);

}  // namespace isojam
