#pragma once

#include <filesystem>
#include <string_view>

namespace isojam {

/// Number of bytes that this process can still allocate: the free memory of the machine, or of one of the control
/// groups that contain the process, whichever is smallest. 0 if a limit is exceeded, infinity if nothing is known.
double available_memory();

/// Smallest number of bytes left in the control groups that contain a process. `groups` is the content of
/// /proc/self/cgroup; `root` is the folder where control groups are mounted. Versions 1 and 2 are read. Infinity if
/// there is no limit.
double available_in_groups(std::string_view groups, const std::filesystem::path& root);

}  // namespace isojam
