#pragma once

#include <stdexcept>

namespace isojam {

/// Exception: the command line asks for something that does not exist, or its options contradict each other.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace isojam
