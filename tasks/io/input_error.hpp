#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace isojam {

/// Exception: an input has one or several errors. what() has one line for each error: "file: pointer: problem; how to
/// correct it".
class InputError : public std::runtime_error {
 public:
  struct Details {
    std::string file;     ///< followed by ":line:column" if the text is not JSON
    std::string pointer;  ///< JSON pointer to the faulty value (RFC 6901); empty for the whole document
    std::string problem;
    std::string allowed;      ///< the accepted values, as in "expected an integer"; empty if `remedy` is given
    std::string suggestion;   ///< name that was probably meant; empty if no known name is similar
    std::string remedy = {};  ///< an instruction, as in "remove the comment"

    /// The accepted values or the instruction.
    const std::string& correction() const { return remedy.empty() ? allowed : remedy; }
  };

  explicit InputError(Details details);
  /// Makes an exception with one or more errors, which are reported in this order.
  explicit InputError(std::vector<Details> all);

  const Details& details() const { return all_.front(); }  ///< the first error
  const std::vector<Details>& all() const { return all_; }

 private:
  std::vector<Details> all_;
};

/// The line of what() for one error. It contains the accepted values only if there is no suggestion.
std::string one_line(const InputError::Details& details);

}  // namespace isojam
