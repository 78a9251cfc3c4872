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
    refused,   ///< by its path, its permissions or the device
    missing,   ///< nothing stands there
    no_file,   ///< something else than a file stands there
    shortage,  ///< the machine has no memory, descriptor or space left
  };

  explicit FileError(const std::string& message, Reason reason = Reason::refused)
      : std::runtime_error(message), reason_(reason) {}
  /// What a system call that has just failed says in errno: "path: what: why".
  static FileError of_errno(const std::filesystem::path& path, std::string_view what);

  Reason reason() const { return reason_; }

 private:
  Reason reason_;
};

/// Open until the end of its scope; invalid, and errno says why, if it could not be opened.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags);
  explicit Descriptor(int number) : fd_(number) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool valid() const { return fd_ >= 0; }
  int number() const { return fd_; }
  /// All of it, or false with the reason in errno.
  bool write(std::string_view content) const;

 private:
  int fd_;
};

/// The bytes of what a person names: a file, or a pipe or device up to 256 MiB. Throws FileError.
std::string read_text(const std::filesystem::path& path);

/// The bytes of a regular file. Throws FileError: no_file for a pipe or device, which might never end.
std::string read_file(const std::filesystem::path& path);

}  // namespace isojam
