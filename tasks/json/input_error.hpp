#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace isojam {

/// Input that is refused. what() has a line for each error: file, JSON pointer, problem, what is allowed, "did you
/// mean".
class InputError : public std::runtime_error {
 public:
  struct Details {
    std::string file;     ///< with ":line:column" where the text is not JSON
    std::string pointer;  ///< RFC 6901; empty for the whole document
    std::string problem;
    std::string allowed;     ///< empty if `problem` says it all
    std::string suggestion;  ///< what was probably meant; empty if nothing is near
  };

  explicit InputError(Details details);
  /// One or more errors, in the order in which they are told.
  explicit InputError(std::vector<Details> all);

  const Details& details() const { return all_.front(); }  ///< of the first
  const std::vector<Details>& all() const { return all_; }

 private:
  std::vector<Details> all_;
};

/// The line of an error.
std::string one_line(const InputError::Details& details);

}  // namespace isojam
