#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace isojam {

/// A directory or file that cannot be read or written.
class FileError : public std::runtime_error {
 public:
  enum class Reason : std::uint8_t {
    refused,   ///< refused by its path, its permissions or the device
    missing,   ///< the path does not exist
    no_file,   ///< not a regular file
    shortage,  ///< no memory, descriptor or disk space left
  };

  explicit FileError(const std::string& message, Reason reason = Reason::refused)
      : std::runtime_error(message), reason_(reason) {}
  /// Error of the system call that has just failed, from errno: "path: what: why".
  static FileError of_errno(const std::filesystem::path& path, std::string_view what);

  Reason reason() const { return reason_; }

 private:
  Reason reason_;
};

/// A file descriptor that is closed at the end of its scope. It is invalid, with the reason in errno, if opening
/// failed.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags);
  explicit Descriptor(int number) : fd_(number) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool valid() const { return fd_ >= 0; }
  int number() const { return fd_; }
  /// Writes everything, or returns false with the reason in errno.
  bool write(std::string_view content) const;

 private:
  int fd_;
};

/// The bytes of a path that the user named: a file, or a pipe or device up to 256 MiB. Throws FileError.
std::string read_text(const std::filesystem::path& path);

/// The bytes of a regular file. Throws FileError: no_file for a pipe or device, which might never end.
std::string read_file(const std::filesystem::path& path);

}  // namespace isojam
