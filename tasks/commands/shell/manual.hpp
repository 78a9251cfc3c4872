#pragma once

#include <string>

#include "tasks/commands/shell/description.hpp"

namespace isojam {

/// The manual page isojam(1), in the macros of man.
std::string manual(const ProgramDescription& program);

}  // namespace isojam
