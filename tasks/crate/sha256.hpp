#pragma once

#include <string>
#include <string_view>

namespace isojam {

/// SHA-256 (FIPS 180-4) of these bytes as 64 hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace isojam
