#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tasks/manifest/manifest.hpp"

namespace isojam {
namespace {

constexpr std::size_t most_named = 5, longest_value = 40;

/// Text of a value for a message, truncated if it is long. Names and numbers are ASCII.
std::string shown(const Json& parent, const std::string& key) {
  if (!parent.contains(key)) return "not given";
  const auto text = compact(parent.at(key));
  return text.size() <= longest_value ? text : text.substr(0, longest_value - 3) + "...";
}

/// Appends a line for each value that differs. Objects are compared key by key, lists as a whole.
void compare(const Json& theirs, const Json& ours, const std::string& pointer, std::vector<std::string>& lines) {
  std::vector<std::string> keys;
  for (const auto* side : {&theirs, &ours}) {
    for (const auto& item : side->items()) {
      if (side == &theirs || !theirs.contains(item.key())) keys.push_back(item.key());
    }
  }
  for (const auto& key : keys) {
    const auto at = pointer + pointer_step(key);
    const bool both = theirs.contains(key) && ours.contains(key);
    if (both && theirs.at(key) == ours.at(key)) continue;
    if (at == "/start/digests") {
      lines.emplace_back("the files of /start/packing are not those of the first run");
    } else if (both && theirs.at(key).is_object() && ours.at(key).is_object()) {
      compare(theirs.at(key), ours.at(key), at, lines);
    } else {
      lines.push_back(
          fmt::format("{}: {} in the directory, {} in this manifest", at, shown(theirs, key), shown(ours, key)));
    }
  }
}

}  // namespace

std::string differences(const Manifest& theirs, const Manifest& ours) {
  std::vector<std::string> lines;
  compare(identity(theirs), identity(ours), "", lines);
  std::string text;
  for (std::size_t k = 0; k < std::min(lines.size(), most_named); ++k) text += (k ? "; " : "") + lines[k];
  return lines.size() <= most_named ? text : fmt::format("{} and {} more", text, lines.size() - most_named);
}

}  // namespace isojam
