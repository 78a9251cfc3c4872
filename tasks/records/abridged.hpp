#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// The part of a record that tables and surveys need.
struct Abridged {
  Json record;                ///< the record without its path, and with empty lists inside its states
  std::string result_digest;  ///< result_digest() of the whole record
};

/// Treatment of the histograms of angles, which are a large part of a record.
enum class Angles : bool { drop, keep };

/// Reads the text of a record and checks its checksum in one pass, several times faster than a parser of any JSON.
/// Returns nullopt if the text differs from what isojam usually writes, for example if a string has an escape sequence.
/// The caller must then parse the text in the usual way, which also reports errors. With Angles::keep, the histograms
/// of angles are whole. Otherwise the states lack them.
std::optional<Abridged> abridged(std::string_view text, Angles angles);

}  // namespace isojam
