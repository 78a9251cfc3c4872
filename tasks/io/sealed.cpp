#include "tasks/io/sealed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "tasks/io/file.hpp"
#include "tasks/io/hash.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/texts.hpp"

namespace isojam {
namespace {

constexpr std::string_view key = "checksum", blank = "0000000000000000", before = "\"checksum\": \"";
/// The checksum must begin within this number of characters. It is the second member, after the short name of the
/// schema.
constexpr std::size_t farthest = 200;
constexpr std::size_t most_levels = 32;

/// Position of the digits of the checksum; npos if there are none.
std::size_t digits_in(std::string_view text) {
  const auto at = text.substr(0, farthest).find(before);
  if (at == std::string_view::npos || text.size() < at + before.size() + blank.size()) return std::string_view::npos;
  return at + before.size();
}

/// Throws if the text is nested too deeply. Copying or writing a parsed value uses stack in proportion to the nesting.
void check_depth(std::string_view text, const std::string& file) {
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      while (++i < text.size() && text[i] != '"') i += text[i] == '\\';
    } else if (c < '[') {
      continue;  // most characters are digits and spaces
    } else if (c == '[' || c == '{') {
      if (++depth > most_levels)
        throw InputError({file, "", std::string(nested_too_deeply), fmt::format("at most {} levels", most_levels), ""});
    } else if (c == ']' || c == '}') {
      depth -= depth > 0;
    }
  }
}

}  // namespace

std::string sealed(const Json& document) {
  assert(document.is_object() && !document.empty() && !document.contains(key));
  Json with_key;
  for (const auto& item : document.items()) {
    with_key[item.key()] = item.value();
    if (with_key.size() == 1) with_key[std::string(key)] = blank;
  }
  auto text = pretty(with_key);
  const auto at = digits_in(text);
  assert(at != std::string::npos);
  text.replace(at, blank.size(), hex_hash(text));
  return text;
}

void check_seal(std::string_view text, const std::string& file) {
  const auto at = digits_in(text);
  if (at == std::string_view::npos)
    throw InputError(
        {file, "/checksum", "the file was not written by isojam, or is incomplete: it has no checksum", "", ""});
  std::string blanked(text);
  blanked.replace(at, blank.size(), blank);
  if (hex_hash(blanked) != text.substr(at, blank.size()))
    throw InputError({file, "/checksum", "the file is damaged: its content does not match its checksum", "", ""});
}

Json parsed_document(std::string_view text, const std::string& file) {
  check_depth(text, file);
  try {
    return parsed(text);
  } catch (const Json::exception& error) {
    throw InputError({file, "", std::string("not valid JSON: ") + error.what(), "", ""});
  }
}

Json parse_sealed(std::string_view text, const std::string& file) {
  check_seal(text, file);
  return parsed_document(text, file);
}

std::string read_result(const std::string& file) {
  try {
    return read_file(file);
  } catch (const FileError& error) {
    if (error.reason() != FileError::Reason::no_file) throw;
    throw InputError({file, "", "not a regular file", "a file written by isojam", ""});
  }
}

Json read_sealed(const std::string& file) { return parse_sealed(read_result(file), file); }

std::map<std::string, std::string> read_sealed_head(const std::string& file) {
  const auto text = read_result(file);
  check_seal(text, file);
  std::map<std::string, std::string> head;
  // sealed() writes each of these members on one line.
  for (std::string_view rest = text; !rest.empty();) {
    auto line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line == "{") continue;
    if (line.ends_with(',')) line.remove_suffix(1);
    const auto member = parsed(fmt::format("{{{}}}", line), false);
    if (!member.is_object() || member.empty() || !member.begin()->is_string()) break;
    head[member.begin().key()] = *member.begin();
  }
  return head;
}

}  // namespace isojam
