#pragma once

#include <stdexcept>
#include <string>

namespace isojam {

/// Input that is refused. what() is one line: file, JSON pointer, problem, what is allowed, "did you mean".
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
  const Details& details() const { return details_; }

 private:
  Details details_;
};

}  // namespace isojam
