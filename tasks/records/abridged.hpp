#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace isojam {

/// States of the decompression that are kept.
enum class States : std::uint8_t { nearest, all };
/// Keys of a state that are kept: none of measures, those that tables need, or all.
enum class Keys : std::uint8_t { none, quantities, all };

struct Abridgement {
  States states = States::all;
  Keys keys = Keys::quantities;
};

/// Shortens the text of a record to what tables or rows need, so that parsing takes a fraction of the time. The text
/// must be one that isojam wrote, with one line for each member, as its checksum shows. The shorter text is a record
/// too, but it has only these states with these keys, its path is empty, and lists are empty. With Keys::quantities it
/// keeps the histograms of angles.
std::string abridged(std::string_view text, const Abridgement& kept);

}  // namespace isojam
