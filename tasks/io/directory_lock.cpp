#include "tasks/io/directory_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>

#include "tasks/io/hash.hpp"

namespace isojam {

static std::unique_ptr<Descriptor> opened(const std::filesystem::path& directory) {
  auto opened = std::make_unique<Descriptor>(directory, O_RDONLY | O_DIRECTORY);
  if (!opened->valid()) throw FileError::of_errno(directory, "cannot be opened");
  return opened;
}

static int lock(const Descriptor& directory, int how) {
  int result = 0;
  do {
    result = ::flock(directory.number(), how);
  } while (result != 0 && errno == EINTR);
  return result;
}

std::optional<DirectoryLock> DirectoryLock::take(const std::filesystem::path& directory, Kind kind) {
  auto own = opened(directory);
  if (lock(*own, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return std::nullopt;
  return DirectoryLock(std::move(own));
}

DirectoryLock DirectoryLock::wait_for(const std::filesystem::path& directory) {
  auto own = opened(directory);
  lock(*own, LOCK_EX);
  return DirectoryLock(std::move(own));
}

void DirectoryLock::share() const { lock(*directory_, LOCK_SH); }

NameLocks::NameLocks(const std::filesystem::path& file)
    : file_(std::make_unique<Descriptor>(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))) {
  if (!file_->valid()) throw FileError::of_errno(file, "cannot be opened");
}

bool NameLocks::set(std::string_view name, bool locked) const {
  // The byte at this position, which lies beyond the end of the file, stands for the name.
  struct flock byte {};
  byte.l_type = static_cast<short>(locked ? F_WRLCK : F_UNLCK);
  byte.l_whence = SEEK_SET;
  byte.l_start = static_cast<off_t>(hash_of(name) >> 2);
  byte.l_len = 1;
  return ::fcntl(file_->number(), F_OFD_SETLK, &byte) == 0 || (errno != EAGAIN && errno != EACCES);
}

}  // namespace isojam
