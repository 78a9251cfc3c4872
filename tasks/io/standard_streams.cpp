#include "tasks/io/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio_ext.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>

#include "tasks/io/file.hpp"

namespace isojam {
namespace {

/// Throws a FileError for the failed write, and discards the buffered output so that it is not written again.
[[noreturn]] void fail() {
  const int error = errno;
  __fpurge(stdout);
  std::clearerr(stdout);
  errno = error;
  throw FileError(FileError::of_errno("standard output", "cannot be written").what(),
                  FileError::Reason::resource_failure);
}

}  // namespace

void open_standard_streams() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    if (::fcntl(fd, F_GETFD) >= 0 || errno != EBADF) continue;
    // open() returns the lowest free number, which is that of the closed stream. Standard output is opened only for
    // reading, so that writing to it fails.
    const int opened = ::open("/dev/null", fd == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    if (opened >= 0 && opened != fd) ::close(opened);
  }
}

void print(std::string_view text) {
  const auto shown = isatty(STDOUT_FILENO) == 1 ? printable(text) : std::string(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size() || std::fflush(stdout) != 0) fail();
}

std::size_t output_columns() {
  winsize size{};
  return isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

void flush_output() {
  errno = EIO;  // because errno may be that of an earlier failure
  if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail();
}

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (code == 0xc2 && next >= 0x80 && next < 0xa0) {
      shown += fmt::format("\\x{:02x}", next);
      ++i;
    } else if ((code < 0x20 && code != '\n' && code != '\t') || code == 0x7f) {
      shown += fmt::format("\\x{:02x}", code);
    } else {
      shown += text[i];
    }
  }
  return shown;
}

}  // namespace isojam
