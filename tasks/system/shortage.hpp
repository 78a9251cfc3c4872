#pragma once

#include <exception>
#include <string_view>

namespace isojam {

/// Whether an exception says what the machine lacks or refuses (memory, threads, descriptors, files) and nothing about
/// what was being computed.
bool is_shortage(const std::exception& error);

/// The same of what such an exception said, where nothing else is left of it.
bool is_shortage_text(std::string_view what);

}  // namespace isojam
