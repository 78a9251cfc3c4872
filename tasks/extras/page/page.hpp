#pragma once

#include <span>
#include <string>

#include "tasks/extras/page/parts.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Makes an HTML file that shows `data`. It consists of common_parts() and the parts in `own`, which must contain the
/// frame. The file is self-contained: it loads no other files. Text in `data` is never interpreted as HTML.
std::string assembled_page(std::span<const PagePart> own, const Json& data);

}  // namespace isojam
