#include "tasks/json/input_error.hpp"

#include <fmt/format.h>

#include <utility>

namespace isojam {
namespace {

std::string one_line(const InputError::Details& details) {
  std::string text = details.file + ": ";
  if (!details.pointer.empty()) text += details.pointer + ": ";
  text += details.problem;
  if (!details.allowed.empty()) text += "; allowed: " + details.allowed;
  if (!details.suggestion.empty()) text += fmt::format("; did you mean \"{}\"?", details.suggestion);
  return text;
}

}  // namespace

InputError::InputError(Details details) : std::runtime_error(one_line(details)), details_(std::move(details)) {}

}  // namespace isojam
