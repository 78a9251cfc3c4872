#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace isojam {

/// Tells a process from every other, also from one that gets its number later.
struct ProcessId {
  std::string machine;       ///< this boot of the kernel, and this space of process numbers
  std::int64_t process = 0;  ///< its number
  std::int64_t started = 0;  ///< clock ticks after boot
};

/// This process.
const ProcessId& this_process();

/// Whether it still runs; nullopt if it is one of another machine.
std::optional<bool> is_alive(const ProcessId& process);

}  // namespace isojam
