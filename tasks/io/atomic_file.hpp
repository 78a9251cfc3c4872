#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace isojam {

enum class Durability : std::uint8_t {
  synced,  ///< the content is on the disk when the call returns
  /// the content is not synchronised to the disk; after a power failure the file may be truncated, which its reader
  /// must detect
  lossless
};

/// Writes a file atomically: every reader, even after a crash, sees either the old content or the complete new content.
/// The function writes a temporary file with a unique name in the same directory, synchronises it (fsync), renames it,
/// and synchronises the directory. It replaces an existing file or symbolic link at the path and does not follow links.
/// Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view content,
                      Durability durability = Durability::synced);

/// Writes a file atomically, but only if the path does not exist. If several processes write at the same time, exactly
/// one succeeds. Returns false and changes nothing if the path exists.
bool write_exclusively(const std::filesystem::path& path, std::string_view content);

/// Writes a file that the user named on the command line. The write is atomic, but the function follows symbolic links
/// and keeps the mode and owner of an existing file. It writes into a pipe or device instead of replacing it. Throws
/// FileError.
void write_output(const std::filesystem::path& path, std::string_view content);

/// Does the same as write_output() for content that is too long for the memory. If the path is not a pipe or device,
/// the file appears only when finish() is called. Each function throws FileError.
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

/// True if the path is a pipe, a device, or a file descriptor of the shell. No other file can be written in the same
/// place.
bool is_stream(const std::filesystem::path& path);

/// Throws FileError if files cannot be written in the directory.
void check_writable(const std::filesystem::path& directory);

/// Removes temporary files of write_atomically() that killed processes left in a directory. It removes files older than
/// an hour, because no process still writes them.
void remove_stale_temporaries(const std::filesystem::path& directory);

}  // namespace isojam
