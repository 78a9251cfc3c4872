#include "tasks/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <system_error>

#include "tasks/io/file.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view cannot_be_written = "cannot be written";

/// The name begins with a dot, so that no reader takes the file for a result. It is random, so that writers on
/// different machines never choose the same name.
fs::path temporary_path_for(const fs::path& path) {
  std::random_device device;
  const auto tag = (static_cast<std::uint64_t>(device()) << 32) | device();
  return path.parent_path() / fmt::format(".{}.{:016x}.tmp", path.filename().string(), tag);
}

/// True if this error means that the file system does not have the system call or its flag.
bool is_unsupported(int error) { return error == EINVAL || error == ENOTSUP || error == ENOSYS || error == EPERM; }

/// A new file in the folder of `path`. The destructor removes it unless it has replaced `path`.
class Temporary {
 public:
  explicit Temporary(const fs::path& path)
      : path_(path), temporary_(temporary_path_for(path)), file_(temporary_, O_WRONLY | O_CREAT | O_EXCL) {}
  ~Temporary() {
    if (file_.valid() && !renamed_) ::unlink(temporary_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(std::string_view content, Durability durability) const {
    if (!file_.valid() || !file_.write(content) || (durability == Durability::synced && ::fsync(file_.number()) != 0))
      throw FileError::of_errno(path_, cannot_be_written);
  }
  /// Copies owner and mode of the replaced file. Only the superuser can change the owner; the mode can always be set.
  void take_after(const struct stat& status) const {
    if (::fchown(file_.number(), status.st_uid, status.st_gid) != 0 && errno != EPERM)
      throw FileError::of_errno(path_, cannot_be_written);
    if (::fchmod(file_.number(), status.st_mode & 07777) != 0) throw FileError::of_errno(path_, cannot_be_written);
  }
  void rename() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw FileError::of_errno(path_, cannot_be_written);
    renamed_ = true;
  }

 private:
  fs::path path_, temporary_;
  Descriptor file_;
  bool renamed_ = false;
};

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Synchronises the folder of a path. Some file systems, for example CIFS, cannot do this and need not.
void sync_directory_of(const fs::path& path) {
  const auto parent = folder_of(path);
  const Descriptor directory(parent, O_RDONLY | O_DIRECTORY);
  const bool done = directory.valid() && ::fsync(directory.number()) == 0;
  if (!done && !(directory.valid() && (is_unsupported(errno) || errno == EBADF)))
    throw FileError::of_errno(parent, "cannot be synchronised");
}

/// Number of the open descriptor to which the path refers, for example 1 for /dev/stdout. nullopt if it refers to none.
std::optional<int> descriptor_at(const fs::path& path) {
  const auto folder = path.parent_path();
  const auto name = path.filename().string();
  if ((folder != "/proc/self/fd" && folder != "/dev/fd") || name.empty() || name.size() > 6 ||
      name.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return std::stoi(name);
}

/// Throws if another user can choose the target of a symbolic link. This concerns sticky folders that everyone can
/// write to, such as /tmp. There, the link must belong to this user or to the owner of the folder. This is the rule of
/// the kernel (fs.protected_symlinks), which does not apply here because the program reads the link itself.
void refuse_link_of_another_user(const fs::path& path) {
  struct stat link {
  }, folder{};
  if (::lstat(path.c_str(), &link) != 0 || ::stat(folder_of(path).c_str(), &folder) != 0)
    throw FileError::of_errno(path, cannot_be_written);
  const auto shared = static_cast<mode_t>(S_ISVTX | S_IWOTH);
  if ((folder.st_mode & shared) != shared || link.st_uid == ::geteuid() || link.st_uid == folder.st_uid) return;
  throw FileError(
      fmt::format("{}: is a symbolic link of another user in a folder that everyone can write to; choose "
                  "another path",
                  path.string()));
}

/// Follows symbolic links to the last path of the chain, which need not exist.
fs::path followed(fs::path path) {
  constexpr int longest_chain = 40;  // the limit in the kernel
  std::error_code error;
  for (int k = 0; !descriptor_at(path) && fs::is_symlink(fs::symlink_status(path, error)); ++k) {
    if (k == longest_chain) {
      errno = ELOOP;
      throw FileError::of_errno(path, cannot_be_written);
    }
    refuse_link_of_another_user(path);
    path = path.parent_path() / fs::read_symlink(path, error);
    if (error) throw FileError::of_error(path, cannot_be_written, error);
  }
  return path;
}

}  // namespace

void write_atomically(const fs::path& path, std::string_view content, Durability durability) {
  Temporary file(path);
  file.write(content, durability);
  file.rename();
  if (durability == Durability::synced) sync_directory_of(path);
}

struct OutputWriter::Target {
  fs::path path;                        ///< path that the user named
  fs::path target;                      ///< path at the end of its symbolic links
  std::optional<Descriptor> opened;     ///< a pipe, a device or an open descriptor, which is written directly
  std::optional<struct stat> replaced;  ///< status of the existing file
  std::optional<Temporary> temporary;

  explicit Target(const fs::path& name) : path(name), target(followed(name)) {
    if (const auto number = descriptor_at(target)) {
      // Write to the descriptor. Do not create a file with this name.
      opened.emplace(::dup(*number));
      require_open();
      return;
    }
    struct stat status {};
    const bool there = ::stat(target.c_str(), &status) == 0;
    if (!there) require_folder();
    if (there && S_ISDIR(status.st_mode))
      throw FileError(path.string() + ": is a directory; give a file", FileError::Reason::no_file);
    if (there && !S_ISREG(status.st_mode)) {
      opened.emplace(target, O_WRONLY);
      require_open();
      return;
    }
    if (there && ::access(target.c_str(), W_OK) != 0) throw FileError::of_errno(path, cannot_be_written);
    if (there) replaced = status;
    temporary.emplace(target);
  }

  void require_folder() const {
    std::error_code error;
    if (fs::status(folder_of(target), error).type() == fs::file_type::not_found)
      throw FileError(folder_of(target).string() + ": no such directory; create it, or choose another output",
                      FileError::Reason::missing);
  }
  void require_open() const {
    if (!opened->valid()) throw FileError::of_errno(path, cannot_be_written);
  }
};

OutputWriter::OutputWriter(const fs::path& path) : target_(std::make_unique<Target>(path)) {}
OutputWriter::~OutputWriter() = default;

void OutputWriter::append(std::string_view content) {
  if (target_->temporary) return target_->temporary->write(content, Durability::lossless);
  if (!target_->opened->write(content)) throw FileError::of_errno(target_->path, cannot_be_written);
}

void OutputWriter::finish() {
  if (!target_->temporary) return;
  auto& file = *target_->temporary;
  file.write("", Durability::synced);
  if (target_->replaced) file.take_after(*target_->replaced);
  file.rename();
  sync_directory_of(target_->target);
}

void write_output(const fs::path& path, std::string_view content) {
  OutputWriter writer(path);
  writer.append(content);
  writer.finish();
}

bool is_stream(const fs::path& path) {
  const auto target = followed(path);
  struct stat status {};
  return descriptor_at(target) ||
         (::stat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode));
}

void check_writable(const fs::path& directory) {
  const auto probe = temporary_path_for(directory / "probe");
  const Descriptor file(probe, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.valid()) throw FileError::of_errno(directory, "cannot be written to");
  ::unlink(probe.c_str());
}

void remove_stale_temporaries(const fs::path& directory) {
  constexpr auto age = std::chrono::hours(1);
  const auto now = fs::file_time_type::clock::now();
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    const auto name = entry.path().filename().string();
    if (!name.starts_with('.') || !name.ends_with(".tmp")) continue;
    // Another process may remove the same file, so errors are ignored.
    std::error_code gone;
    const auto written = fs::last_write_time(entry.path(), gone);
    if (!gone && now - written > age) fs::remove(entry.path(), gone);
  }
}

}  // namespace isojam
