#pragma once

#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Settings that are allowed, and of which it is known that they cannot give a good result: a line for each, which
/// begins with its JSON pointer. Of several values of a sweep the first is named.
std::vector<std::string> warnings_of(const Manifest& manifest);

}  // namespace isojam
