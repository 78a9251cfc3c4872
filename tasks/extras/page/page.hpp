#pragma once

#include <span>
#include <string>

#include "tasks/extras/page/parts.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Makes one HTML file that shows `data`, from the common parts and the parts in `own`, which include the frame. The
/// file is self-contained: it loads no other files. Text in the data is never interpreted as HTML.
std::string assembled_page(std::span<const PagePart> own, const Json& data);

}  // namespace isojam
