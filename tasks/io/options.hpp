#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tasks/io/place.hpp"

// Functions that read, write and describe the values of options in manifests and configurations. The functions that
// read throw InputError. If errors are collected (see JsonPlace), a returned list does not contain the entries with
// errors.

namespace isojam {

/// Reads a list. `read` converts one entry to a value. Two entries with the same value are an error. `allowed`
/// describes the allowed lists in error messages.
template <class Read>
auto read_list(const JsonPlace& place, std::string_view allowed, Read read) {
  const auto size = place.expect_list(allowed);
  std::vector<decltype(read(place))> values;
  for (std::size_t k = 0; k < size; ++k) {
    place.attempt([&] {
      const auto entry = place.at(k);
      auto value = read(entry);
      if (std::find(values.begin(), values.end(), value) != values.end())
        entry.refuse_with_remedy(fmt::format("{} is given twice", compact(entry.value())), "give each value once");
      values.push_back(std::move(value));
    });
  }
  return values;
}

/// Reads the value of an option. If it is a number, it must be in `range`.
template <class T>
T read_option(const JsonPlace& place, [[maybe_unused]] const Range& range) {
  if constexpr (std::is_enum_v<T>) {
    return place.choice<T>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return place.boolean();
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(place.integer(range));
  } else {
    return place.number(range);
  }
}

/// Text that describes the allowed values of an option, such as "a number in (0, 1]".
template <class T>
std::string allowed_option([[maybe_unused]] const Range& range) {
  if constexpr (std::is_enum_v<T>) {
    return one_of(all_names<T>);
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_integral_v<T>) {
    return integer_in(range);
  } else {
    return number_in(range);
  }
}

/// The value of an option as JSON.
template <class T>
Json option_json(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return to_string(value);
  } else {
    return value;
  }
}

/// Reads a list of one or more values that are all different.
template <class T>
void read_option(const JsonPlace& place, const Range& range, std::vector<T>& list) {
  list = read_list(place, "a list of one or more values",
                   [&](const JsonPlace& entry) { return read_option<T>(entry, range); });
  if (place.value().empty()) place.refuse("the list is empty", "one or more values");
}
template <class T>
void read_option(const JsonPlace& place, const Range& range, T& value) {
  value = read_option<T>(place, range);
}

template <class T>
Json option_json(const std::vector<T>& list) {
  Json json = Json::array();
  for (const T& value : list) json.push_back(option_json(value));
  return json;
}

}  // namespace isojam
