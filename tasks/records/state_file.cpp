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
  const Json expected = written(StateFileHead{std::string(schema), identity});
  for (const auto& item : expected.items()) {
    const auto& key = item.key();
    if (text_at(key) != item.value().get<std::string>()) return key;
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
                    written(StateFileHead{std::string(schema), identities.front()}).at(key).dump(), ""});
}

}  // namespace

void describe(Fields& field, StateFileHead& head) {
  field("schema", head.schema, "Name and version of the file format.");
  field("checksum", head.checksum,
        "64-bit FNV-1a checksum of the text of the file. It is computed with zeros in place of the 16 digits of this "
        "field.");
  field("replicate", head.identity.replicate, "Name of the replicate. It is also the name of the file of its record.");
  field("spec_digest", head.identity.spec_digest,
        "Digest of the specification of the replicate without measures, and of the seed, as in the record.");
  field("result_digest", head.identity.result_digest,
        "Field `result_digest` of the record. If measures were added later, it may be the digest from before an "
        "addition.");
}

void describe(Fields& field, PackingFile& file) {
  field.type("",
             "The state nearest jamming of a replicate. Lengths are in units of V_p^(1/3), where V_p is the mean "
             "particle volume. Each exact coordinate is the sum of two doubles; fields whose names end in `_low` "
             "contain the second, smaller one. Near jamming, a state has a residual below 1e-8 only if both doubles "
             "are added.");
  describe(field, file.head);
  describe(field, file.packing);
}

void describe(Fields& field, PathState& state) {
  field("delta_phi", state.delta_phi, "Distance to jamming, Δφ = φ − φ_J; null if there is no φ_J.").range({-1, 1});
  describe(field, state.packing);
}

void describe(Fields& field, PathFile& file) {
  field.type("",
             "All states of the decompression of a replicate; isojam writes them if the manifest sets `keep_path`. The "
             "units are those of packing files.");
  describe(field, file.head);
  field("states", file.states, "States of the decompression, in the order of the list `states` of the record.")
      .length(1);
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
