#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace isojam {

enum class Durability : std::uint8_t {
  synced,   ///< on the disk when the call returns
  lossless  ///< after a power failure the file may be cut short, which its reader must notice
};

/// Writes a file so that any reader, and anyone after a crash, sees either the old content or the whole new one:
/// a temporary of a name of its own in the same directory, fsync, rename, fsync of the directory. What stood at the
/// path, a symbolic link too, is replaced and never written through. Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view content,
                      Durability durability = Durability::synced);

/// The same where nothing stands yet, of several writers for exactly one. False, and nothing is changed, if something
/// stands there.
bool write_exclusively(const std::filesystem::path& path, std::string_view content);

/// Writes what a person asked for under a name of theirs: atomically, but where a symbolic link points, with the mode
/// and owner of the file that stands there, and into a pipe or device instead of replacing it. Throws FileError.
void write_output(const std::filesystem::path& path, std::string_view content);

/// write_output() of what is too long to be held at once. Nothing stands at the path before finish(), nor ever without
/// it, unless it is a pipe or a device. Each function throws FileError.
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

/// Whether what is written under that name goes into a pipe, a device or what a shell has opened: nothing can stand
/// beside.
bool is_stream(const std::filesystem::path& path);

/// Throws FileError unless files can be written in the directory.
void check_writable(const std::filesystem::path& directory);

/// Removes what writers that were killed left in a directory: temporaries older than an hour, by which no writer is
/// still busy.
void remove_stale_temporaries(const std::filesystem::path& directory);

}  // namespace isojam
