#include "tasks/records/state_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"

namespace isojam {
namespace {

/// The first key whose value differs from that of the identity; empty if all are equal. text_at(key) is the value of a
/// key, or empty if the key is missing.
template <class TextAt>
std::string difference(std::string_view schema, const RecordIdentity& identity, const TextAt& text_at) {
  const Json expected = state_file_head(schema, identity);
  for (const auto& item : expected.items()) {
    const auto& key = item.key();
    // Files of earlier versions have the digest of the manifest in place of that of the specification.
    const auto text = key == "spec_digest" && text_at(key).empty() ? text_at("manifest_digest") : text_at(key);
    if (text != item.value().get<std::string>()) return key;
  }
  return "";
}

template <class TextAt>
void check_head(const std::string& file, std::string_view schema, std::span<const RecordIdentity> identities,
                const TextAt& text_at) {
  const auto is_own = [&](const RecordIdentity& identity) { return difference(schema, identity, text_at).empty(); };
  if (std::any_of(identities.begin(), identities.end(), is_own)) return;
  const auto key = difference(schema, identities.front(), text_at);
  throw InputError({file, pointer_step(key), fmt::format("\"{}\" does not match the record", text_at(key)),
                    state_file_head(schema, identities.front()).at(key).dump(), ""});
}

}  // namespace

Json state_file_head(std::string_view schema, const RecordIdentity& identity) {
  Json json;
  json["schema"] = schema;
  json["replicate"] = identity.replicate;
  json["spec_digest"] = identity.spec_digest;
  json["result_digest"] = identity.result_digest;
  return json;
}

void check_state_file(const std::string& file, std::string_view schema, std::span<const RecordIdentity> identities) {
  const auto head = read_sealed_head(file);
  check_head(file, schema, identities, [&](const std::string& key) {
    const auto found = head.find(key);
    return found == head.end() ? std::string() : found->second;
  });
}

Json read_state_file(const std::string& file, std::string_view schema, std::span<const RecordIdentity> identities) {
  auto json = read_sealed(file);
  check_head(file, schema, identities, [&](const std::string& key) {
    const auto found = json.find(key);
    return found == json.end() || !found->is_string() ? std::string() : found->template get<std::string>();
  });
  return json;
}

}  // namespace isojam
