#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// The part of a record that tables and `isojam status` need.
struct Abridged {
  /// The record without `path` and `checksum`. Its members `spec` and `provenance` are complete. In every other member,
  /// only the histograms of angles are complete: all other lists inside the member are empty.
  Json record;
  std::string result_digest;  ///< result_digest() of the whole record
};

/// Treatment of the states of the decompression, which are the largest part of a record.
enum class States : bool { drop, keep };

/// Reads the text of a record and checks its checksum in one pass, several times faster than a general JSON parser.
/// Returns nullopt if the checksum is wrong, or if the text differs from what isojam usually writes, for example if a
/// string has an escape sequence. The caller must then parse the text in the usual way, which also reports errors. With
/// States::drop, the list of states is empty.
std::optional<Abridged> abridged(std::string_view text, States states);

}  // namespace isojam
