#pragma once

#include <string>

#include "tasks/io/json.hpp"

namespace isojam {

/// Text about the failure of a replicate for messages: the reason, the last strain step, and a remedy if there is one.
/// `record` is its complete record. The reason in the record is longer, and never changes, because it is part of the
/// result digest.
std::string failure_text(const Json& record);

}  // namespace isojam
