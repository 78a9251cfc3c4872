#include "tasks/replicate/companion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tasks/json/input_error.hpp"
#include "tasks/json/sealed.hpp"

namespace isojam {
namespace {

/// Where the head is not that of this owner; empty if it is. `text_at` gives the value of a key; empty if there is
/// none.
template <class TextAt>
std::string difference(std::string_view schema, const Owner& owner, const TextAt& text_at) {
  const Json expected = companion(schema, owner);
  for (const auto& item : expected.items()) {
    if (text_at(item.key()) != item.value().get<std::string>()) return item.key();
  }
  return "";
}

template <class TextAt>
void check_head(const std::string& file, std::string_view schema, std::span<const Owner> owners,
                const TextAt& text_at) {
  const auto is_own = [&](const Owner& owner) { return difference(schema, owner, text_at).empty(); };
  if (std::any_of(owners.begin(), owners.end(), is_own)) return;
  const auto key = difference(schema, owners.front(), text_at);
  throw InputError({file, pointer_step(key), fmt::format("\"{}\" is not what its record says", text_at(key)),
                    companion(schema, owners.front()).at(key).dump(), ""});
}

}  // namespace

Json companion(std::string_view schema, const Owner& owner) {
  Json json;
  json["schema"] = schema;
  json["replicate"] = owner.replicate;
  json["manifest_digest"] = owner.manifest_digest;
  json["result_digest"] = owner.result_digest;
  return json;
}

void check_companion(const std::string& file, std::string_view schema, std::span<const Owner> owners) {
  const auto head = read_sealed_head(file);
  check_head(file, schema, owners, [&](const std::string& key) {
    const auto found = head.find(key);
    return found == head.end() ? std::string() : found->second;
  });
}

Json read_companion(const std::string& file, std::string_view schema, std::span<const Owner> owners) {
  auto json = read_sealed(file);
  check_head(file, schema, owners, [&](const std::string& key) {
    const auto found = json.find(key);
    return found == json.end() || !found->is_string() ? std::string() : found->template get<std::string>();
  });
  return json;
}

}  // namespace isojam
