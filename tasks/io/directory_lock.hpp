#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
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
  /// Waits for an exclusive lock that every process holds only for a moment.
  static DirectoryLock wait_for(const std::filesystem::path& directory);
  /// Makes an exclusive lock a shared one.
  void share() const;

 private:
  explicit DirectoryLock(std::unique_ptr<Descriptor> directory) : directory_(std::move(directory)) {}
  std::unique_ptr<Descriptor> directory_;
};

/// Locks on names, each of which at most one process holds. A lock is released when its process ends for any reason. On
/// a file system without locks, every process gets every lock.
class NameLocks {
 public:
  /// `file` is created if it is missing, and remains empty. Throws FileError if it cannot be opened.
  explicit NameLocks(const std::filesystem::path& file);

  bool take(std::string_view name) const { return set(name, true); }  ///< false if another process has this lock
  void release(std::string_view name) const { set(name, false); }

 private:
  bool set(std::string_view name, bool locked) const;
  std::unique_ptr<Descriptor> file_;
};

}  // namespace isojam
