#pragma once

#include <string_view>

namespace isojam {

// Texts of messages that several source files use.

inline constexpr std::string_view nested_too_deeply = "nested too deeply";
inline constexpr std::string_view how_to_resume = "recorded results are kept; repeat the command to resume";
inline constexpr std::string_view interrupted_run =
    "interrupted; recorded results are kept; repeat the command to resume";

}  // namespace isojam
