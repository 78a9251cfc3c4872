#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace isojam {

/// The lines of a text file and their words. Lines end with \n, \r\n or \r. A byte order mark of UTF-8 is skipped.
/// Errors are ContentErrors with the number of the line.
class TextLines {
 public:
  /// A comment extends from the character `comment` to the end of its line; 0: there are no comments. Throws
  /// ContentError if the text is in UTF-16.
  explicit TextLines(std::string_view text, char comment = '\0');

  /// Moves to the next line, which may be empty. Returns false at the end of the file.
  bool next_line();
  /// Moves to the next line that contains a word.
  bool next();
  /// Moves to the next word, if necessary on a later line, and returns it. It is empty at the end of the file.
  std::string_view next_word();
  /// Omits the other words of this line from next_word().
  void skip_line() { taken_ = words_.size(); }

  std::size_t number() const { return number_; }  ///< number of the present line, from 1
  std::string_view text() const { return line_; }
  const std::vector<std::string_view>& words() const { return words_; }

  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy = "") const;
  double real(std::string_view word) const;  ///< a finite number, with or without a sign
  /// An integer from `low` to `high`. `noun` names it in the error.
  long integer(std::string_view word, long low, long high, std::string_view noun) const;

 private:
  std::string_view rest_, line_;
  char comment_;
  std::size_t number_ = 0, taken_ = 0;
  std::vector<std::string_view> words_;
};

/// The words of a line, which blanks and tabs separate.
std::vector<std::string_view> words_of(std::string_view line);
/// The word with small letters. Only the letters of ASCII change.
std::string lower_case(std::string_view word);
/// The beginning of a word of the file, in quotation marks, for messages.
std::string in_quotes(std::string_view word);

}  // namespace isojam
