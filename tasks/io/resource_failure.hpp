#pragma once

#include <exception>
#include <string_view>

namespace isojam {

/// True if an exception was caused by a resource failure: memory, threads or file descriptors ran out, or a file could
/// not be read or written. Such a failure is not a result of the computation.
bool is_resource_failure(const std::exception& error);

/// True if the text of an exception describes a resource failure. Use it where only this text is known.
bool is_resource_failure_text(std::string_view what);

}  // namespace isojam
