#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tasks/io/console.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam {

/// Prints warnings about settings of a manifest that cannot give a good result.
void warn_about(const Manifest& manifest, const std::string& file, Console& console);

/// Prints a warning if the engine computes without AVX2 and FMA.
void warn_about_kernels(Console& console);

/// One line of text about the last strain step of a replicate.
std::string step_text(const ReplicateSpec& spec, const JamProgress& progress);

/// Names of all records of a directory. Throws FileError if it has no records.
std::vector<std::string> recorded_names(const std::string& directory);
/// Returns `name` if there is a record with this name. Otherwise throws FileError with the most similar name. Only
/// names of existing records therefore become parts of paths.
std::string recorded_name(const std::string& directory, const std::string& name);

/// Throws the FileError for a name that is not in `names`.
[[noreturn]] void throw_unknown_replicate(const std::string& directory, const std::string& name,
                                          const std::vector<std::string>& names);

/// Error text for a directory that another process has locked.
std::string in_use(const std::string& directory);

/// Text with the version and the commit, and on a second line the schemas of the files that this version reads.
std::string version_text();

/// A number with a noun in singular or plural, such as "1 thread" or "2 threads".
std::string counted(std::size_t number, std::string_view noun);

/// An amount of memory, such as "3.2 GB" or "45 kB".
std::string bytes_text(double bytes);

}  // namespace isojam
