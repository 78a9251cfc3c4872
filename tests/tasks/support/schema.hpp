#pragma once

#include <string>

#include "tasks/io/json.hpp"

namespace isojam::test {

/// schemas/<name>.schema.json
Json schema(const std::string& name);

/// Violations that a draft-07 validator finds in a document; empty if it conforms.
std::string violations(const std::string& schema_name, const Json& document);

}  // namespace isojam::test
