#include "tasks/io/resource_failure.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <system_error>

#include "tasks/io/file.hpp"

namespace isojam {

bool is_resource_failure(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::system_error*>(&error) ||
         dynamic_cast<const FileError*>(&error) || is_resource_failure_text(error.what());
}

bool is_resource_failure_text(std::string_view what) {
  // If a thread cannot be created, oneTBB throws a runtime_error whose text begins in one of these ways.
  static constexpr std::array<std::string_view, 5> beginnings{"std::bad_alloc", "pthread_", "Cannot allocate memory",
                                                              "Resource temporarily unavailable",
                                                              "Too many open files"};
  return std::any_of(beginnings.begin(), beginnings.end(), [&](std::string_view b) { return what.starts_with(b); });
}

}  // namespace isojam
