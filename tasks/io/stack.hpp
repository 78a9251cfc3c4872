#pragma once

#include <functional>

namespace isojam {

/// Calls `work` with at least 8 MiB of stack, and returns its result. If the limit of the process is smaller (ulimit
/// -s), a thread with such a stack does the work, and later threads also get such a stack. `work` must not throw.
/// Throws std::system_error if the thread cannot be created.
int with_enough_stack(const std::function<int()>& work);

}  // namespace isojam
