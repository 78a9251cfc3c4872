#include "tasks/replicate/companion.hpp"

#include <fmt/format.h>

#include <map>

#include "tasks/json/input_error.hpp"
#include "tasks/json/sealed.hpp"

namespace isojam {
namespace {

/// `text_at` gives the value of a key; empty if there is none.
template <class TextAt>
void check_head(const std::string& file, std::string_view schema, const Owner& owner, const TextAt& text_at) {
  const Json expected = companion(schema, owner);
  for (const auto& item : expected.items()) {
    const std::string found = text_at(item.key());
    if (found == item.value()) continue;
    throw InputError({file, pointer_step(item.key()), fmt::format("\"{}\" is not what its record says", found),
                      item.value().dump(), ""});
  }
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

void check_companion(const std::string& file, std::string_view schema, const Owner& owner) {
  const auto head = read_sealed_head(file);
  check_head(file, schema, owner, [&](const std::string& key) {
    const auto found = head.find(key);
    return found == head.end() ? std::string() : found->second;
  });
}

Json read_companion(const std::string& file, std::string_view schema, const Owner& owner) {
  auto json = read_sealed(file);
  check_head(file, schema, owner, [&](const std::string& key) {
    const auto found = json.find(key);
    return found == json.end() || !found->is_string() ? std::string() : found->template get<std::string>();
  });
  return json;
}

}  // namespace isojam
