#pragma once

#include <string>
#include <string_view>

namespace isojam {

/// Puts something in the place of those of the descriptors 0 to 2 that are closed, before any file is opened: it would
/// get their number, and what is meant for people would be written into it. What is written to a closed standard
/// output still fails.
void open_standard_streams();

/// Writes to standard output, through to whoever reads it; to a terminal as printable() has it. Throws FileError.
void print(std::string_view text);

/// For who has written to standard output otherwise: throws FileError if some of it was lost.
void flush_output();

/// The text with every control character (C0, C1 in UTF-8, DEL) but line feed and tab as "\x1b": what stands in the
/// name of a file must not command a terminal.
std::string printable(std::string_view text);

}  // namespace isojam
