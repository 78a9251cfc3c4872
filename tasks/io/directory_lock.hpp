#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "tasks/io/file.hpp"

namespace isojam {

/// A lock on a directory. The lock is released when the object is destroyed, or when its process ends for any reason.
/// It is advisory: it does not stop a process that does not take a lock. On a file system without locks it has no
/// effect.
class DirectoryLock {
 public:
  enum class Kind : std::uint8_t {
    shared,    ///< other processes may hold shared locks at the same time
    exclusive  ///< no other process may hold a lock at the same time
  };
  /// Takes a lock. Returns nullopt if another process has a lock that excludes this one. Throws FileError if the
  /// directory cannot be opened.
  static std::optional<DirectoryLock> take(const std::filesystem::path& directory, Kind kind);

 private:
  explicit DirectoryLock(std::unique_ptr<Descriptor> directory) : directory_(std::move(directory)) {}
  std::unique_ptr<Descriptor> directory_;
};

}  // namespace isojam
