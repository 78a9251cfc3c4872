#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "tasks/io/place.hpp"

namespace isojam {

/// Exception: the content of a file is not a solid or a packing that isojam can read. what() states the problem.
class ContentError : public std::runtime_error {
 public:
  explicit ContentError(const std::string& problem, std::string remedy = "", std::size_t line = 0)
      : std::runtime_error(problem), remedy_(std::move(remedy)), line_(line) {}

  const std::string& remedy() const { return remedy_; }  ///< how to correct the file; empty if this is evident
  std::size_t line() const { return line_; }             ///< number of the line, from 1; 0 for no line

 private:
  std::string remedy_;
  std::size_t line_;
};

/// Throws the InputError for the content of the file at `path`, which the value at `place` names. `allowed` is the
/// content that is expected.
[[noreturn]] void refuse_content(const JsonPlace& place, const std::string& path, const ContentError& error,
                                 std::string_view allowed);

/// Reads the bytes of the regular file at `path`, which the value at `place` names. An error of the path is reported at
/// `place`. A resource failure is thrown as a FileError, because it is not an error of the manifest.
std::string read_named_file(const JsonPlace& place, const std::string& path, std::string_view allowed);

}  // namespace isojam
