#pragma once

#include <exception>
#include <string_view>

namespace isojam {

/// True if an exception was caused by a resource failure: memory, threads, file descriptors or files. Such a failure is
/// not a result of the computation.
bool is_resource_failure(const std::exception& error);

/// True if the text of an exception describes a resource failure. It is used if only the text of the exception is
/// available.
bool is_resource_failure_text(std::string_view what);

}  // namespace isojam
