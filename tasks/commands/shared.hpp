#pragma once

#include <string>
#include <string_view>

#include "tasks/replicate/replicate.hpp"
#include "tasks/system/console.hpp"

namespace isojam {

/// Says which settings of a manifest cannot give a good result.
void warn_about(const Manifest& manifest, const std::string& file, Console& console);

/// One line about the last step of a replicate.
std::string step_text(const ReplicateSpec& spec, const JamProgress& progress);

/// "1 thread", "2 threads".
std::string counted(std::size_t number, std::string_view noun);

/// "3.2 GB", "45 kB".
std::string bytes_text(double bytes);

}  // namespace isojam
