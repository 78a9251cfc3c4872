#pragma once

#include <string>

#include "tasks/io/json.hpp"

namespace isojam::test {

/// The content of schemas/<name>.schema.json.
Json schema(const std::string& name);

/// Violations of a schema that a draft-07 validator finds in a document; empty if there are none.
std::string violations(const std::string& schema_name, const Json& document);
std::string violations_of(const Json& schema, const Json& document);

}  // namespace isojam::test
