#pragma once

#include <string>

#include "tasks/commands/description.hpp"

namespace isojam {

/// The text of the manual page isojam(1), with man macros.
std::string manual(const ProgramDescription& program);

}  // namespace isojam
