#include "tasks/io/process.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <system_error>
#include <thread>

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

int with_enough_stack(const std::function<int()>& work) {
#ifdef __GLIBC__
  // The usual limit on Linux. Eigen alone puts matrices of up to 128 KiB on the stack.
  constexpr rlim_t needed = rlim_t{8} << 20;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < needed) {
    const auto throw_if = [](int error) {
      if (error != 0) throw std::system_error(error, std::generic_category(), "cannot set the stack size of threads");
    };
    pthread_attr_t attributes;
    throw_if(::pthread_attr_init(&attributes));
    throw_if(::pthread_attr_setstacksize(&attributes, needed));
    throw_if(::pthread_setattr_default_np(&attributes));
    throw_if(::pthread_attr_destroy(&attributes));
    int result = 0;
    std::thread([&] { result = work(); }).join();
    return result;
  }
#endif
  return work();
}

}  // namespace isojam
