#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace isojam {

/// States of the decompression that are kept.
enum class States : std::uint8_t { nearest, all };

/// Shortens the text of a record to what tables need, so that parsing takes a fraction of the time. The text must be
/// one that isojam wrote, with one line for each member, as its checksum shows. The shorter text is a record too, but
/// its path is empty, its states have only the keys of quantities, and lists are empty, except histograms of angles.
/// With States::nearest it has only the state nearest jamming.
std::string abridged(std::string_view text, States states);

}  // namespace isojam
