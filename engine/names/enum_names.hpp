#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace isojam {

/// An enumerator and its name in files and messages.
template <class Enum>
struct EnumName {
  Enum value;             ///< the enumerator
  std::string_view name;  ///< its name
};
/// For clang before version 17, which cannot deduce the template argument of an aggregate.
template <class Enum>
EnumName(Enum, std::string_view) -> EnumName<Enum>;

/// The names of an enumeration, in the order in which messages list them. Each enumerator occurs once. Specialise this
/// variable directly after the enumeration, so that to_string() and from_string() work for it:
///
///   enum class Axis { x, y };
///   template <>
///   inline constexpr std::array enum_names<Axis>{EnumName{Axis::x, "x"}, EnumName{Axis::y, "y"}};
template <class Enum>
inline constexpr std::array<EnumName<Enum>, 0> enum_names{};

template <class Enum>
concept NamedEnum = std::is_enum_v<Enum> && !enum_names<Enum>.empty();

/// The name of an enumerator. It must have a name; otherwise an assertion fails.
template <NamedEnum Enum>
constexpr std::string_view to_string(Enum value) {
  for (const auto& entry : enum_names<Enum>) {
    if (entry.value == value) return entry.name;
  }
  assert(false);
  return "";
}

/// The enumerator with this name, or nullopt if there is none.
template <NamedEnum Enum>
constexpr std::optional<Enum> from_string(std::string_view name) {
  for (const auto& entry : enum_names<Enum>) {
    if (entry.name == name) return entry.value;
  }
  return std::nullopt;
}

/// All enumerators that have names, in the order of enum_names.
template <NamedEnum Enum>
inline constexpr auto all_of = [] {
  std::array<Enum, enum_names<Enum>.size()> values{};
  std::transform(enum_names<Enum>.begin(), enum_names<Enum>.end(), values.begin(),
                 [](const EnumName<Enum>& entry) { return entry.value; });
  return values;
}();

/// The names of all enumerators, in the order of enum_names.
template <NamedEnum Enum>
inline constexpr auto all_names = [] {
  std::array<std::string_view, enum_names<Enum>.size()> names{};
  std::transform(enum_names<Enum>.begin(), enum_names<Enum>.end(), names.begin(),
                 [](const EnumName<Enum>& entry) { return entry.name; });
  return names;
}();

}  // namespace isojam
