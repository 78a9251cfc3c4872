#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace isojam {

/// Identifies a process. It is unique even if the system later gives the process number to another process.
struct ProcessId {
  std::string machine;       ///< identifies the boot of the machine and the PID namespace
  std::int64_t process = 0;  ///< process number (PID)
  std::int64_t started = 0;  ///< start of the process, in clock ticks since the boot
};

const ProcessId& this_process();

/// True if the process still runs. nullopt if it belongs to another machine, boot or PID namespace.
std::optional<bool> is_alive(const ProcessId& process);

/// Returns work(). If the limit of the process for the stack is smaller than usual (ulimit -s) and the C library is
/// glibc, a thread with the usual size does the work, and later threads also have this size. `work` must not throw.
/// Throws std::system_error if the thread cannot be created.
int with_enough_stack(const std::function<int()>& work);

}  // namespace isojam
