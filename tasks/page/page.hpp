#pragma once

#include <span>
#include <string>

#include "tasks/json/json.hpp"
#include "tasks/page/parts.hpp"

namespace isojam {

/// One self-contained HTML file of the common parts and `own`, one of which is the frame, that shows `data`. It loads
/// nothing from elsewhere, and text in the data is never interpreted as markup.
std::string assembled_page(std::span<const PagePart> own, const Json& data);

}  // namespace isojam
