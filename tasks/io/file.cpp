#include "tasks/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace isojam {
namespace {

constexpr std::size_t longest_stream = std::size_t{256} << 20;
constexpr std::size_t longest_block = std::size_t{1} << 16, shortest_block = 512;
constexpr std::string_view cannot_be_read = "cannot be read";

FileError::Reason reason_of(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR: return FileError::Reason::missing;
    case EISDIR:
    case ELOOP:
    case ENXIO: return FileError::Reason::no_file;
    case ENOMEM:
    case EMFILE:
    case ENFILE:
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
    case EAGAIN:
    case EINTR:
    case ESTALE: return FileError::Reason::resource_failure;
    default: return FileError::Reason::refused;
  }
}

/// Appends the rest of the file to `text`. Blocks fill the capacity of `text`, so that a file of known size takes two
/// calls. Returns false, with the reason in errno, if this fails.
bool read_rest(int fd, std::size_t most, std::string& text) {
  for (;;) {
    const auto size = text.size();
    const auto block = std::clamp(text.capacity() - size, shortest_block, longest_block);
    if (size > most) {
      errno = EFBIG;
      return false;
    }
    text.resize(size + block);
    const auto got = ::read(fd, text.data() + size, block);
    const int error = errno;
    text.resize(size + (got > 0 ? static_cast<std::size_t>(got) : 0));
    if (got == 0) return true;
    if (got < 0 && error != EINTR) {
      errno = error;
      return false;
    }
  }
}

/// Returns false, with the reason in errno, if there is not enough memory. malloc is tried first, because the caller
/// can then name the file in its message. If operator new failed, the program would end without the name.
bool reserve(std::string& text, std::size_t size) {
  // NOLINTBEGIN(cppcoreguidelines-no-malloc): only tests whether so much memory is available
  void* const probe = std::malloc(size);
  const bool enough = probe != nullptr && size < text.max_size();
  std::free(probe);
  // NOLINTEND(cppcoreguidelines-no-malloc)
  if (enough) text.reserve(size);
  if (!enough) errno = ENOMEM;
  return enough;
}

std::string read_opened(const Descriptor& file, const std::filesystem::path& path, bool any_kind) {
  struct stat status {};
  if (!file.valid() || ::fstat(file.number(), &status) != 0) throw FileError::of_errno(path, cannot_be_read);
  if (S_ISDIR(status.st_mode) || (!any_kind && !S_ISREG(status.st_mode)))
    throw FileError(fmt::format("{}: is {}, not a file", path.string(),
                                S_ISDIR(status.st_mode) ? "a directory" : "a pipe or a device"),
                    FileError::Reason::no_file);
  std::string text;
  const bool regular = S_ISREG(status.st_mode);
  if (regular && !reserve(text, static_cast<std::size_t>(status.st_size) + shortest_block))
    throw FileError::of_errno(path, cannot_be_read);
  if (!read_rest(file.number(), regular ? text.max_size() / 2 : longest_stream, text))
    throw FileError::of_errno(path, cannot_be_read);
  return text;
}

}  // namespace

FileError FileError::of_errno(const std::filesystem::path& path, std::string_view what) {
  return of_error(path, what, {errno, std::generic_category()});
}

FileError FileError::of_error(const std::filesystem::path& path, std::string_view what, std::error_code error) {
  return FileError(fmt::format("{}: {}: {}", path.string(), what, error.message()), reason_of(error.value()));
}

Descriptor::Descriptor(const std::filesystem::path& path, int flags)
    : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

bool Descriptor::write(std::string_view content) const {
  while (!content.empty()) {
    const auto written = ::write(fd_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string read_text(const std::filesystem::path& path) { return read_opened({path, O_RDONLY}, path, true); }

std::string read_file(const std::filesystem::path& path) {
  // With O_NONBLOCK a pipe opens at once, even if it has no writer.
  return read_opened({path, O_RDONLY | O_NONBLOCK}, path, false);
}

}  // namespace isojam
