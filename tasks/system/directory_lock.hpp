#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "tasks/system/file.hpp"

namespace isojam {

/// A lock on a directory, released with the object or when its process ends for any reason. It is advisory: processes
/// that do not take it are not blocked. It has no effect on file systems without locks.
class DirectoryLock {
 public:
  enum class Kind : std::uint8_t {
    shared,    ///< compatible with other shared locks
    exclusive  ///< compatible with no other lock
  };
  /// nullopt if another process holds an incompatible lock. Throws FileError if the directory is missing.
  static std::optional<DirectoryLock> take(const std::filesystem::path& directory, Kind kind);

 private:
  explicit DirectoryLock(std::unique_ptr<Descriptor> directory) : directory_(std::move(directory)) {}
  std::unique_ptr<Descriptor> directory_;
};

}  // namespace isojam
