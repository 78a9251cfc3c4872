#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace isojam {

/// Refused input. what() has one line per error: file, JSON pointer, problem, allowed values, "did you mean".
class InputError : public std::runtime_error {
 public:
  struct Details {
    std::string file;     ///< followed by ":line:column" if the text is not JSON
    std::string pointer;  ///< RFC 6901; empty for the whole document
    std::string problem;
    std::string allowed;     ///< empty if `problem` is complete by itself
    std::string suggestion;  ///< the probably intended name; empty if none is near
  };

  explicit InputError(Details details);
  /// One or more errors, in the order in which they are reported.
  explicit InputError(std::vector<Details> all);

  const Details& details() const { return all_.front(); }  ///< of the first error
  const std::vector<Details>& all() const { return all_; }

 private:
  std::vector<Details> all_;
};

/// One line for an error.
std::string one_line(const InputError::Details& details);

}  // namespace isojam
