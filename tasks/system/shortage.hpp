#pragma once

#include <exception>
#include <string_view>

namespace isojam {

/// True if an exception is a resource failure (memory, threads, descriptors, files), which says nothing about the
/// computation.
bool is_shortage(const std::exception& error);

/// The same for the text of an exception, if only the text is left.
bool is_shortage_text(std::string_view what);

}  // namespace isojam
