#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace isojam {

enum class Durability : std::uint8_t {
  synced,   ///< on the disk when the call returns
  lossless  ///< after a power failure the file may be truncated, which its reader must detect
};

/// Writes a file so that every reader, even after a crash, sees either the old content or the complete new one. It uses
/// a uniquely named temporary file in the same directory, fsync, rename, and fsync of the directory. An existing file
/// or symbolic link at the path is replaced; links are not followed. Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view content,
                      Durability durability = Durability::synced);

/// The same, but only if the path does not exist; of several writers exactly one succeeds. Returns false and changes
/// nothing if the path exists.
bool write_exclusively(const std::filesystem::path& path, std::string_view content);

/// Writes a file that the user named. Atomic, but follows symbolic links, keeps mode and owner of an existing file, and
/// writes into a pipe or device instead of replacing it. Throws FileError.
void write_output(const std::filesystem::path& path, std::string_view content);

/// write_output() for content too long to hold in memory. Unless the path is a pipe or a device, nothing appears there
/// before finish(). Each function throws FileError.
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

/// True if a path is a pipe, a device or a descriptor opened by a shell, beside which no other file can be written.
bool is_stream(const std::filesystem::path& path);

/// Throws FileError if files cannot be written in the directory.
void check_writable(const std::filesystem::path& directory);

/// Removes temporary files that killed writers left in a directory. Files older than an hour have no active writer.
void remove_stale_temporaries(const std::filesystem::path& directory);

}  // namespace isojam
