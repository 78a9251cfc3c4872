#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace isojam {

/// Opens those of the standard streams (descriptors 0 to 2) that are closed. Call it before any file is opened:
/// otherwise a file would get the number of a closed stream, and messages would be written into this file. If standard
/// output was closed, writing to it still fails.
void open_standard_streams();

/// Writes a text to standard output and flushes it. If standard output is a terminal, it writes printable(text). Throws
/// FileError.
void print(std::string_view text);

/// Width of the terminal to which standard output is connected, in characters. 0 if it is no terminal, or if the width
/// is unknown.
std::size_t output_columns();

/// Flushes what other functions wrote to standard output. Throws FileError if a part of it was lost.
void flush_output();

/// The text with escapes such as "\x1b" in place of control characters (C0, C1 in UTF-8, DEL), except line feed and
/// tab. Without this, a file name could control the terminal.
std::string printable(std::string_view text);

}  // namespace isojam
