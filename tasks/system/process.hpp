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

/// Goes on as another program of the same directory as this one, with these words, of which the first is replaced by
/// its path; ended by null. Throws FileError if it is not there or cannot be run.
[[noreturn]] void become(const std::string& program, char** words);

/// Whether it still runs; nullopt if it is one of another machine.
std::optional<bool> is_alive(const ProcessId& process);

}  // namespace isojam
