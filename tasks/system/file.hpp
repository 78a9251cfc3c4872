#pragma once

#include <stdexcept>
#include <string>

namespace isojam {

/// A directory or file that cannot be read or written, as named on the command line.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a file. Throws FileError if it cannot be read.
std::string read_text(const std::string& file);

}  // namespace isojam
