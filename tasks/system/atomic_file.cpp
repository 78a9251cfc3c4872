#include "tasks/system/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <random>
#include <system_error>

#include "tasks/system/file.hpp"

namespace isojam {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what) {
  throw FileError(fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(errno)));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool valid() const { return fd_ >= 0; }
  bool sync() const { return ::fsync(fd_) == 0; }
  bool write(std::string_view content) const {
    while (!content.empty()) {
      const auto written = ::write(fd_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

 private:
  int fd_;
};

/// Hidden, so that no reader takes it for a result; random, so that writers on different machines never meet.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  std::random_device device;
  const auto tag = (static_cast<std::uint64_t>(device()) << 32) | device();
  return path.parent_path() / fmt::format(".{}.{:016x}.tmp", path.filename().string(), tag);
}

bool write_and_rename(const std::filesystem::path& temporary, const std::filesystem::path& path,
                      std::string_view content, Durability durability) {
  const Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL);
  return file.valid() && file.write(content) && (durability == Durability::lossless || file.sync()) &&
         std::rename(temporary.c_str(), path.c_str()) == 0;
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view content, Durability durability) {
  const auto temporary = temporary_beside(path);
  if (!write_and_rename(temporary, path, content, durability)) {
    const int reason = errno;
    ::unlink(temporary.c_str());
    errno = reason;
    fail(path, "cannot be written");
  }
  if (durability == Durability::lossless) return;
  const auto parent = path.parent_path();
  const Descriptor directory(parent.empty() ? "." : parent, O_RDONLY | O_DIRECTORY);
  if (!directory.valid() || !directory.sync()) fail(parent, "cannot be synchronised");
}

void check_writable(const std::filesystem::path& directory) {
  const auto probe = temporary_beside(directory / "probe");
  const Descriptor file(probe, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.valid()) fail(directory, "cannot be written to");
  ::unlink(probe.c_str());
}

void remove_stale_temporaries(const std::filesystem::path& directory) {
  constexpr auto age = std::chrono::hours(1);
  const auto now = std::filesystem::file_time_type::clock::now();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
    const auto name = entry.path().filename().string();
    if (!name.starts_with('.') || !name.ends_with(".tmp")) continue;
    // Another process may be tidying up too: what has gone is as good as removed.
    std::error_code gone;
    const auto written = std::filesystem::last_write_time(entry.path(), gone);
    if (!gone && now - written > age) std::filesystem::remove(entry.path(), gone);
  }
}

}  // namespace isojam
