#pragma once

#include <string_view>

namespace isojam {

std::string_view version();  ///< version of the project
/// commit of the sources when the build was configured, or "unknown" if they were not in a repository
std::string_view git_hash();
/// Name and version of the compiler.
std::string_view compiler();

}  // namespace isojam
