#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace isojam {

/// Guarantee for the content of a file after a power failure.
enum class Durability : std::uint8_t {
  synced,  ///< the complete content is on the disk when the call returns
  /// the content may not be on the disk yet; after a power failure the file may be truncated, which its reader must
  /// detect
  lossless
};

/// Writes a file atomically: every reader sees either the old content or the complete new content, even after the
/// process has crashed. The function writes a temporary file with a unique name in the same directory and renames it.
/// With Durability::synced, it also synchronises the file and the directory (fsync). It replaces an existing file or
/// symbolic link at the path. Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view content,
                      Durability durability = Durability::synced);

/// Writes a file that the user named on the command line. The write is atomic. Unlike write_atomically(), the function
/// follows symbolic links, keeps the mode of an existing file, and its owner if the system permits this. It writes into
/// a pipe or device instead of replacing it. Throws FileError.
void write_output(const std::filesystem::path& path, std::string_view content);

/// Writes like write_output(), but in several parts, for content that does not fit in the memory. A regular file
/// appears only when finish() is called; until then, an existing file does not change. All functions throw FileError.
class OutputWriter {
 public:
  explicit OutputWriter(const std::filesystem::path& path);
  ~OutputWriter();
  OutputWriter(const OutputWriter&) = delete;
  OutputWriter& operator=(const OutputWriter&) = delete;

  void append(std::string_view content);
  void finish();

 private:
  struct Target;
  std::unique_ptr<Target> target_;
};

/// True if the path is a pipe, a device, or an open file descriptor, such as /dev/stdout. Other files cannot be written
/// beside it.
bool is_stream(const std::filesystem::path& path);

/// Throws FileError if no file can be created in the directory.
void check_writable(const std::filesystem::path& directory);

/// Removes temporary files of write_atomically() that remain in a directory after a process was killed. It removes only
/// files older than an hour, because a younger file may still be in use.
void remove_stale_temporaries(const std::filesystem::path& directory);

}  // namespace isojam
