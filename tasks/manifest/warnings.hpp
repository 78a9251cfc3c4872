#pragma once

#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Settings that are allowed but are known to give no good result. Each line begins with its JSON pointer. For a sweep
/// only the first value concerned is named.
std::vector<std::string> warnings_of(const Manifest& manifest);

}  // namespace isojam
