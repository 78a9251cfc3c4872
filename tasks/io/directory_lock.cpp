#include "tasks/io/directory_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>

namespace isojam {

std::optional<DirectoryLock> DirectoryLock::take(const std::filesystem::path& directory, Kind kind) {
  auto opened = std::make_unique<Descriptor>(directory, O_RDONLY | O_DIRECTORY);
  if (!opened->valid()) throw FileError::of_errno(directory, "cannot be opened");
  const int how = (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB;
  int result = 0;
  do {
    result = ::flock(opened->number(), how);
  } while (result != 0 && errno == EINTR);
  if (result != 0 && errno == EWOULDBLOCK) return std::nullopt;
  return DirectoryLock(std::move(opened));
}

}  // namespace isojam
