#pragma once

#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Warnings about settings that are allowed but probably give no good result. Each text begins with the JSON pointer of
/// the setting. There is one warning for each setting, or one for each setting and solid if the problem depends on the
/// solid. If several values of a sweep have the problem, the warning names only the first one.
std::vector<std::string> warnings_of(const Manifest& manifest);

}  // namespace isojam
