#include "tasks/io/hash.hpp"

#include <fmt/format.h>

namespace isojam {

std::string hex_hash(std::string_view text) { return fmt::format("{:016x}", hash_of(text)); }

}  // namespace isojam
