#pragma once

#include <array>
#include <functional>
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
using Slot = std::variant<double*, int*, long*, bool*, Method*, Control*, CellShape*, CohesionUntil*>;

/// A parameter of the engine that a manifest may set or sweep. Its default value is that of the member in JamOptions.
struct Field {
  /// Name; no parameter of the other group has the same name. If it contains a dot, the part before the dot is the name
  /// of an object in the group, and the part after the dot is the key in this object. The key in `sweep` and `base` is
  /// the whole name.
  std::string_view name;
  Group group;
  Slot (*slot)(JamOptions&);
  Range range;  ///< allowed values, if the parameter is a number
};

/// True if the parameter is in an object of its group.
bool is_nested(const Field& field);
/// JSON pointer to a parameter in its group, such as /protocol/cohesion/range.
std::string pointer_of(const Field& field);

/// All parameters: first those of the protocol, then those of the minimiser. Manifests and records list them in this
/// order.
std::span<const Field> all_fields();
/// The parameter with this name; nullptr if there is none.
const Field* find_field(std::string_view name);

/// Refuses parameters of version 0.1.0 that were removed, and states what to use instead.
void refuse_removed(const JsonPlace& place);

/// Text that describes the allowed values, such as "a number in (0, 1]".
std::string allowed_values(const Field& field);

/// Reads the value of a parameter into `options`. Throws InputError if the value has another type or is not allowed.
void read_field(const JsonPlace& place, const Field& field, JamOptions& options);
/// The value of a parameter in `options`.
Json field_value(const Field& field, JamOptions options);

/// All parameters of a group with their values, as a JSON object.
Json group_values(Group group, const JamOptions& options);
/// Removes a parameter from the result of group_values(), and then its object if this is empty.
void erase_field(Json& values, const Field& field);

/// Calls `read` for each parameter of the group that `place` has, inside attempt(). Reports unknown keys: the keys in
/// `others` are known too, and `elsewhere` is as in JsonPlace::expect_keys().
void read_group_fields(const JsonPlace& place, Group group, std::span<const std::string_view> others,
                       std::string (*elsewhere)(std::string_view),
                       const std::function<void(const JsonPlace&, const Field&)>& read);

}  // namespace isojam
