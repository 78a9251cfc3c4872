#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/names/enum_names.hpp"
#include "tasks/commands/description.hpp"

namespace isojam {

enum class Shell : std::uint8_t { bash, zsh, fish };
template <>
inline constexpr std::array enum_names<Shell>{EnumName{Shell::bash, "bash"}, EnumName{Shell::zsh, "zsh"},
                                              EnumName{Shell::fish, "fish"}};

/// The completion script for a shell. It completes commands, options, their values, and names of files and directories.
std::string completions(const ProgramDescription& program, Shell shell);

}  // namespace isojam
