#pragma once

#include <string>
#include <vector>

#include "tasks/io/json.hpp"

namespace isojam::test {

/// A manifest with an error, and the expected error message.
struct BadManifest {
  std::string name;
  std::string text;
  std::string pointer;   ///< JSON pointer of the error; empty if the error belongs to no particular value
  std::string says;      ///< a part of the expected message
  bool schema_can_tell;  ///< true if the JSON schema of manifests finds the error too
};

/// A manifest without errors. Each bad manifest differs from it in one place.
Json good_manifest();

std::vector<BadManifest> bad_manifests();

}  // namespace isojam::test
