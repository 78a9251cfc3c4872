#include "tasks/json/sealed.hpp"

#include <cassert>

#include "tasks/json/hash.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/system/file.hpp"

namespace isojam {
namespace {

constexpr std::string_view key = "checksum", blank = "0000000000000000", before = "\"checksum\": \"";
/// The checksum stands second; names of schemas are short.
constexpr std::size_t farthest = 200;

/// Where the digits stand; npos if there are none.
std::size_t digits_in(std::string_view text) {
  const auto at = text.substr(0, farthest).find(before);
  if (at == std::string_view::npos || text.size() < at + before.size() + blank.size()) return std::string_view::npos;
  return at + before.size();
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
    throw InputError({file, "/checksum", "the file has no checksum", "a file as isojam wrote it, whole", ""});
  std::string blanked(text);
  blanked.replace(at, blank.size(), blank);
  if (hex_hash(blanked) != text.substr(at, blank.size()))
    throw InputError({file, "/checksum", "the file is damaged: its content has another checksum",
                      "a file as isojam wrote it, whole", ""});
}

Json parse_sealed(std::string_view text, const std::string& file) {
  check_seal(text, file);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw InputError({file, "", std::string("not valid JSON: ") + error.what(), "", ""});
  }
}

Json read_sealed(const std::string& file) { return parse_sealed(read_text(file), file); }

}  // namespace isojam
