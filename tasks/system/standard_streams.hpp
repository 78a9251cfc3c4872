#pragma once

#include <string>
#include <string_view>

namespace isojam {

/// Opens those of the descriptors 0 to 2 that are closed, before any file is opened. Otherwise a file would get their
/// number, and messages would be written into it. Writing to a closed standard output still fails.
void open_standard_streams();

/// Writes to standard output and flushes it; on a terminal the text is escaped by printable(). Throws FileError.
void print(std::string_view text);

/// Checks output that was written to standard output by other means: throws FileError if some of it was lost.
void flush_output();

/// The text with every control character (C0, C1 in UTF-8, DEL) except line feed and tab escaped as "\x1b". A file name
/// must not control a terminal.
std::string printable(std::string_view text);

}  // namespace isojam
