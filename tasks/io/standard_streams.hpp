#pragma once

#include <string>
#include <string_view>

namespace isojam {

/// Opens the standard streams (descriptors 0 to 2) that are closed. Call it before any file is opened. Otherwise a file
/// would get the number of a closed stream, and messages would be written into this file. Writing to a closed standard
/// output still fails.
void open_standard_streams();

/// Writes a text to standard output and flushes it. If standard output is a terminal, printable() is applied to the
/// text. Throws FileError.
void print(std::string_view text);

/// Flushes output that was written to standard output by other functions. Throws FileError if some of the output was
/// lost.
void flush_output();

/// The text in which every control character (C0, C1 in UTF-8, DEL) except line feed and tab is replaced by an escape
/// such as "\x1b". Otherwise the name of a file could control the terminal.
std::string printable(std::string_view text);

}  // namespace isojam
