#pragma once

#include <string>
#include <string_view>

#include "engine/random/stream.hpp"

namespace isojam {

/// The value of hash_of(text) as 16 hexadecimal digits.
std::string hex_hash(std::string_view text);

}  // namespace isojam
