#include "tasks/io/input_error.hpp"

#include <fmt/format.h>

#include <utility>

namespace isojam {
namespace {

std::string lines(const std::vector<InputError::Details>& all) {
  std::string text;
  for (const auto& details : all) text += (text.empty() ? "" : "\n") + one_line(details);
  return text;
}

}  // namespace

std::string problem_line(const InputError::Details& details) {
  return details.file + ": " + (details.pointer.empty() ? "" : details.pointer + ": ") + details.problem;
}

std::string one_line(const InputError::Details& details) {
  const auto text = problem_line(details);
  if (!details.suggestion.empty()) return text + fmt::format("; did you mean \"{}\"?", details.suggestion);
  if (!details.remedy.empty()) return text + "; " + details.remedy;
  return details.allowed.empty() ? text : text + "; expected " + details.allowed;
}

InputError::InputError(Details details) : std::runtime_error(one_line(details)), all_{std::move(details)} {}
InputError::InputError(std::vector<Details> all) : std::runtime_error(lines(all)), all_(std::move(all)) {}

}  // namespace isojam
