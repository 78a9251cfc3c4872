#pragma once

#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Warnings about settings that are allowed but cannot give a good result. Each text begins with the JSON pointer of
/// the setting. If several values of a sweep have the same problem, only the first one is named.
std::vector<std::string> warnings_of(const Manifest& manifest);

}  // namespace isojam
