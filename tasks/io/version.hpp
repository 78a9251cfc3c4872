#pragma once

#include <string_view>

namespace isojam {

std::string_view version();   ///< version of the project
std::string_view git_hash();  ///< commit of the sources when the build was configured; "unknown" outside a repository
std::string_view compiler();

}  // namespace isojam
