#include "tasks/packings/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "tasks/packings/content_error.hpp"

namespace isojam {
namespace {

constexpr std::string_view blanks = " \t\v\f";
constexpr std::size_t longest_quote = 20;

/// std::from_chars does not accept a plus sign.
std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

/// std::from_chars. libc++ has it for doubles only since version 20; std::strtod also accepts hexadecimal numbers.
std::from_chars_result from_chars(std::string_view word, double& value) {
#ifdef __cpp_lib_to_chars
  return std::from_chars(word.data(), word.data() + word.size(), value);
#else
  const std::string copy(word);
  char* end = nullptr;
  value = std::strtod(copy.c_str(), &end);
  return {word.data() + (end - copy.c_str()), end == copy.c_str() ? std::errc::invalid_argument : std::errc()};
#endif
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (auto at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

std::string in_quotes(std::string_view word) {
  std::string text(word.substr(0, longest_quote));
  for (char& c : text) c = c >= ' ' && c <= '~' ? c : '?';
  return fmt::format("\"{}{}\"", text, word.size() > longest_quote ? "..." : "");
}

TextLines::TextLines(std::string_view text, char comment) : rest_(text), comment_(comment) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  if (rest_.starts_with("\xFF\xFE") || rest_.starts_with("\xFE\xFF"))
    throw ContentError("the text is encoded in UTF-16", "save it in UTF-8", 1);
}

bool TextLines::next_line() {
  words_.clear();
  taken_ = 0;
  if (rest_.empty()) return false;
  ++number_;
  const auto end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (rest_.starts_with("\r\n")) rest_.remove_prefix(1);
  if (!rest_.empty()) rest_.remove_prefix(1);
  words_ = words_of(comment_ == '\0' ? line_ : line_.substr(0, line_.find(comment_)));
  return true;
}

bool TextLines::next() {
  while (next_line()) {
    if (!words_.empty()) return true;
  }
  return false;
}

std::string_view TextLines::next_word() {
  if (taken_ == words_.size() && !next()) return {};
  return words_[taken_++];
}

void TextLines::refuse(const std::string& problem, const std::string& remedy) const {
  throw ContentError(problem, remedy, number_);
}

double TextLines::real(std::string_view word) const {
  constexpr const char* remedy = "write a number such as -0.5 or 1e-3";
  double value = 0;
  word = without_plus(word);
  const auto [end, error] = from_chars(word, value);
  if (error == std::errc::result_out_of_range && end == word.data() + word.size())
    refuse(fmt::format("{} is outside the range of double precision", in_quotes(word)), remedy);
  if (word.empty() || error != std::errc() || end != word.data() + word.size())
    refuse(fmt::format("{} is not a number", in_quotes(word)), remedy);
  if (!std::isfinite(value)) refuse(fmt::format("{} is not a finite number", in_quotes(word)), remedy);
  return value;
}

long TextLines::integer(std::string_view word, long low, long high, std::string_view noun) const {
  long value = 0;
  word = without_plus(word);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = !word.empty() && error != std::errc::invalid_argument && end == word.data() + word.size();
  if (!whole) refuse(fmt::format("{} is not the {}", in_quotes(word), noun), "write an integer there");
  if (error != std::errc() || value < low || value > high)
    refuse(fmt::format("the {} is {}", noun, word), fmt::format("it must be an integer from {} to {}", low, high));
  return value;
}

}  // namespace isojam
