#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace isojam {

/// Identifies a process uniquely, even if its number is reused later.
struct ProcessId {
  std::string machine;       ///< identifies the boot of the kernel and the PID namespace
  std::int64_t process = 0;  ///< process number (PID)
  std::int64_t started = 0;  ///< clock ticks after boot
};

const ProcessId& this_process();

/// True if the process still runs; nullopt if it belongs to another machine.
std::optional<bool> is_alive(const ProcessId& process);

}  // namespace isojam
