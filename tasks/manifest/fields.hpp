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

/// The object of the manifest that contains a parameter, unless the parameter is swept.
enum class Group { protocol, minimiser };
template <>
inline constexpr std::array enum_names<Group>{EnumName{Group::protocol, "protocol"},
                                              EnumName{Group::minimiser, "minimiser"}};

/// Pointer to the member of JamOptions that stores the value of a parameter.
using Slot = std::variant<double*, int*, long*, bool*, Method*, Consolidation*, Control*, CellShape*>;

/// A parameter of the engine that a manifest may set or sweep. Its default value is that of the member in JamOptions.
struct Field {
  std::string_view name;  ///< name; no parameter of the other group has the same name
  Group group;
  Slot (*slot)(JamOptions&);
  Range range;  ///< allowed values, if the parameter is a number
};

/// All parameters: first those of the protocol, then those of the minimiser. Manifests and records list them in this
/// order.
std::span<const Field> all_fields();
/// The parameter with this name; nullptr if there is none.
const Field* find_field(std::string_view name);

/// Present name of a parameter that an earlier version of isojam called `name`. Empty if no parameter had this name.
std::string_view new_name(std::string_view name);

/// Text that describes the allowed values, such as "a number in (0, 1]".
std::string allowed_values(const Field& field);

/// Reads the value of a parameter into `options`. Throws InputError if the value has another type or is not allowed.
void read_field(const JsonPlace& place, const Field& field, JamOptions& options);
/// The value of a parameter in `options`.
Json field_value(const Field& field, JamOptions options);

/// All parameters of a group with their values, as a JSON object.
Json group_values(Group group, const JamOptions& options);

}  // namespace isojam
