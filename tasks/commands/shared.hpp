#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tasks/io/console.hpp"
#include "tasks/io/describe.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// A kind of file with its description, for the commands `schema` and `fields`.
struct DocumentKind {
  std::string_view name, title;
  Fields (*fields)();
};
/// All kinds. Commands that other kinds of files belong to add these.
std::vector<DocumentKind>& documents();

/// Prints the warnings that warnings_of() returns for a manifest. `file` is the name of the manifest in these warnings.
void warn_about(const Manifest& manifest, const std::string& file, Console& console);

/// One line for each user-defined solid, see definition_text().
std::string definitions_text(const Manifest& manifest);

/// Prints a warning if the processor has no fused multiply-add, because the program is then slower.
void warn_without_fma(Console& console);

/// One line of text about the latest strain step of a replicate.
std::string step_text(const ReplicateSpec& spec, const JamProgress& progress);

/// Names of all records in a directory. Throws FileError if there are none.
std::vector<std::string> recorded_names(const std::string& directory);
/// Returns `name` if a record has this name. Otherwise throws the error of throw_unknown_replicate(). With this check,
/// text such as "../x" cannot become part of a path.
std::string recorded_name(const std::string& directory, const std::string& name);

/// Throws a UsageError which states that no record has this name. It suggests the most similar name in `names`, or an
/// example of a name if none is similar.
[[noreturn]] void throw_unknown_replicate(const std::string& directory, const std::string& name,
                                          const std::vector<std::string>& names);

/// Prints the first table of a directory, the tables that its manifest requests, and the tables of `measures`. They are
/// at most as wide as the terminal.
void print_tables(const Table& table, const std::string& directory, const std::vector<Measure>& measures = {});

/// Text of the option --version: version and commit, and on a second line the schemas of the files that this version
/// writes.
std::string version_text();

/// Writes a text to the file `output`, or prints it if `output` is empty.
void print_or_write(const std::string& text, const std::string& output);

/// A path as one argument of a shell command, in quotation marks if it has characters with a meaning in a shell.
std::string shell_argument(const std::string& path);

/// A number with a noun in the singular or plural, such as "1 thread" or "2 threads".
std::string counted(std::size_t number, std::string_view noun);

/// An amount of memory with decimal units, such as "3.2 GB" or "45 kB".
std::string bytes_text(double bytes);

}  // namespace isojam
