#pragma once

#include <vector>

#include "tasks/io/place.hpp"

namespace isojam {

/// The names of the enumerators as a JSON list.
template <NamedEnum T>
Json option_json(const std::vector<T>& list) {
  Json json = Json::array();
  for (const T& value : list) json.push_back(to_string(value));
  return json;
}

}  // namespace isojam
