#pragma once

#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

inline constexpr std::string_view earlier_record_schema = "isojam.replicate.v3";

/// True if the document is a record of version 3.
bool is_earlier_record(const Json& document);

/// Converts a record of version 3 to version 4, in which each measure has one object with its name. Any other document
/// is returned unchanged. The value of result_digest stays the same, because the files of the packing and the path
/// contain it.
Json upgraded_record(Json record);

}  // namespace isojam
