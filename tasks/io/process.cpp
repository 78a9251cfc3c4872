#include "tasks/io/process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <system_error>

#include "tasks/io/file.hpp"

namespace isojam {
namespace {

/// Content of a file, or an empty text if it cannot be read. Without /proc, no process counts as running.
std::string read_if_present(const std::string& file) {
  try {
    return read_text(file);
  } catch (const FileError& error) {
    if (error.reason() == FileError::Reason::resource_failure) throw;
    return "";
  }
}

std::string this_machine() {
  const auto boot = read_if_present("/proc/sys/kernel/random/boot_id");
  std::error_code error;
  const auto numbers = std::filesystem::read_symlink("/proc/self/ns/pid", error).string();
  return boot.substr(0, boot.find('\n')) + ' ' + numbers;
}

/// Start time of a process (field 22 of /proc/PID/stat), or 0 if there is no such process. The name of the program,
/// field 2, may contain blanks and parentheses.
std::int64_t start_of(std::int64_t process) {
  constexpr int field_after_name = 3, start = 22;
  const auto stat = read_if_present(fmt::format("/proc/{}/stat", process));
  const auto end = stat.rfind(')');
  if (end == std::string::npos) return 0;
  std::istringstream fields(stat.substr(end + 1));
  std::string field;
  for (int k = field_after_name; k <= start; ++k) fields >> field;
  std::int64_t ticks = 0;
  std::istringstream(field) >> ticks;
  return ticks;
}

}  // namespace

const ProcessId& this_process() {
  static const ProcessId id{this_machine(), getpid(), start_of(getpid())};
  return id;
}

std::optional<bool> is_alive(const ProcessId& process) {
  if (process.machine != this_process().machine) return std::nullopt;
  return start_of(process.process) == process.started;
}

}  // namespace isojam
