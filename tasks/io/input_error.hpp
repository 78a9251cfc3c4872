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
    std::string file;     ///< name of the input; ":line:column" follows if the text is not JSON
    std::string pointer;  ///< JSON pointer to the value with the error (RFC 6901); empty for the whole document
    std::string problem;
    std::string allowed;      ///< the allowed values, to be printed after "expected"; empty if `remedy` is given
    std::string suggestion;   ///< name that the user probably meant; empty if no known name is similar
    std::string remedy = {};  ///< an instruction, such as "remove the comment"

    /// The allowed values or the instruction.
    const std::string& correction() const { return remedy.empty() ? allowed : remedy; }
  };

  explicit InputError(Details details);
  /// Makes an exception with one or more errors, in this order.
  explicit InputError(std::vector<Details> all);

  const Details& details() const { return all_.front(); }  ///< the first error
  const std::vector<Details>& all() const { return all_; }

 private:
  std::vector<Details> all_;
};

/// The line of what() for one error, without the allowed values, the suggestion or the remedy.
std::string problem_line(const InputError::Details& details);
/// The line of what() for one error. If there is a suggestion, the line contains it instead of the allowed values or
/// the remedy.
std::string one_line(const InputError::Details& details);

}  // namespace isojam
