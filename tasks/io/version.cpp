#include "tasks/io/version.hpp"

namespace isojam {

std::string_view version() { return ISOJAM_VERSION; }
std::string_view git_hash() { return ISOJAM_GIT_HASH; }
std::string_view compiler() { return ISOJAM_COMPILER; }

}  // namespace isojam
