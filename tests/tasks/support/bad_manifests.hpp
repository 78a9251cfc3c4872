#pragma once

#include <string>
#include <vector>

#include "tasks/io/json.hpp"

namespace isojam::test {

/// A manifest that must be refused, and its expected error.
struct BadManifest {
  std::string name;
  std::string text;
  std::string pointer;   ///< of the error; empty: of no particular value
  std::string says;      ///< a part of the message
  bool schema_can_tell;  ///< whether draft-07 can express the rule (text that is not JSON never gets that far)
};

/// A manifest that is accepted; the bad ones differ from it in one place.
Json good_manifest();

std::vector<BadManifest> bad_manifests();

}  // namespace isojam::test
