#pragma once

#include <string>

namespace isojam::test {

/// The first table that a command printed. The lines after it name the directory.
inline std::string first_table(const std::string& out) { return out.substr(0, out.find("\n\n")); }

}  // namespace isojam::test
