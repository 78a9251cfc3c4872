#pragma once

#include <span>
#include <string>

#include "tasks/json/json.hpp"
#include "tasks/page/parts.hpp"

namespace isojam {

/// One self-contained HTML file of the common parts followed by `own`, one of which is the frame, that shows `data`:
/// nothing is fetched, and no text of the data is ever markup.
std::string assembled_page(std::span<const PagePart> own, const Json& data);

}  // namespace isojam
