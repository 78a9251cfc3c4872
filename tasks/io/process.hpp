#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace isojam {

/// Identifies a process uniquely, even if the system reuses its process number later.
struct ProcessId {
  std::string machine;       ///< identifier of the running kernel (its boot) and of the PID namespace
  std::int64_t process = 0;  ///< process number (PID)
  std::int64_t started = 0;  ///< start of the process, in clock ticks after the boot
};

const ProcessId& this_process();

/// True if the process still runs. nullopt if it belongs to another machine.
std::optional<bool> is_alive(const ProcessId& process);

}  // namespace isojam
