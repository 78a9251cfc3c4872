#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace isojam {

/// Exception: a file or directory cannot be read or written.
class FileError : public std::runtime_error {
 public:
  enum class Reason : std::uint8_t {
    refused,  ///< a reason other than those below, such as missing permissions
    missing,  ///< the path does not exist
    /// the path is a directory, a pipe, a device or a loop of symbolic links, where a regular file is needed
    no_file,
    resource_failure,  ///< memory, file descriptors or disk space ran out, or the device reported an error
  };

  explicit FileError(const std::string& message, Reason reason = Reason::refused)
      : std::runtime_error(message), reason_(reason) {}
  /// Makes the error of the system call that has just failed; errno has the reason. The message is "path: what:
  /// reason".
  static FileError of_errno(const std::filesystem::path& path, std::string_view what);
  /// Makes the error of a function that returned an error code. The message has the same form.
  static FileError of_error(const std::filesystem::path& path, std::string_view what, std::error_code error);

  Reason reason() const { return reason_; }

 private:
  Reason reason_;
};

/// A file descriptor, which the destructor closes. If the file cannot be opened, the descriptor is invalid and errno
/// has the reason.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags);
  explicit Descriptor(int number) : fd_(number) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool valid() const { return fd_ >= 0; }
  int number() const { return fd_; }
  /// Writes the whole content. If this fails, returns false, and errno has the reason.
  bool write(std::string_view content) const;

 private:
  int fd_;
};

/// Reads the bytes of a path that the user named on the command line: a regular file of any size, or a pipe or device
/// with at most 256 MiB. Throws FileError.
std::string read_text(const std::filesystem::path& path);

/// Reads the bytes of a regular file. Throws FileError; the reason is no_file for a pipe or device, from which a read
/// might never end.
std::string read_file(const std::filesystem::path& path);

}  // namespace isojam
