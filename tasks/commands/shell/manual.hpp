#pragma once

#include <string>

#include "tasks/commands/shell/description.hpp"

namespace isojam {

/// The manual page isojam(1), in man macros.
std::string manual(const ProgramDescription& program);

}  // namespace isojam
