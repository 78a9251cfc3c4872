#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "tasks/system/file.hpp"

namespace isojam {

/// A hold on a directory that ends with the object or its process, however that ends. Processes that ask for none are
/// not held back; nor is anybody where the file system knows no locks.
class DirectoryLock {
 public:
  enum class Kind : std::uint8_t {
    shared,    ///< with others of this kind
    exclusive  ///< alone
  };
  /// nullopt if somebody else holds the directory in a way that does not go together with this. Throws FileError if it
  /// is not there.
  static std::optional<DirectoryLock> take(const std::filesystem::path& directory, Kind kind);

 private:
  explicit DirectoryLock(std::unique_ptr<Descriptor> directory) : directory_(std::move(directory)) {}
  std::unique_ptr<Descriptor> directory_;
};

}  // namespace isojam
