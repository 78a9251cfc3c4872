#pragma once

#include <filesystem>
#include <string_view>

namespace isojam {

/// Writes a file so that any reader, and anyone after a crash, sees either the old content or the whole new one:
/// a temporary of a name of its own in the same directory, fsync, rename, fsync of the directory.
/// Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace isojam
