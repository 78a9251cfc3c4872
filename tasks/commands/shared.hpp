#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tasks/replicate/replicate.hpp"
#include "tasks/system/console.hpp"

namespace isojam {

/// Warns about settings of a manifest that cannot give a good result.
void warn_about(const Manifest& manifest, const std::string& file, Console& console);

/// Warns that the engine computes without AVX2 and FMA, if it does.
void warn_about_kernels(Console& console);

/// One line about the last step of a replicate.
std::string step_text(const ReplicateSpec& spec, const JamProgress& progress);

/// Names of all records of a directory. Throws FileError if there are none.
std::vector<std::string> recorded_names(const std::string& directory);
/// Returns the name if a record has it, so that no other name ever becomes part of a path. Otherwise throws FileError
/// with the nearest name.
std::string recorded_name(const std::string& directory, const std::string& name);

/// Version and commit; on a second line the schemas of the files that results are read from.
std::string version_text();

/// "1 thread", "2 threads".
std::string counted(std::size_t number, std::string_view noun);

/// "3.2 GB", "45 kB".
std::string bytes_text(double bytes);

}  // namespace isojam
