#pragma once

#include <string>

#include "tasks/json/json.hpp"

namespace isojam {

/// One self-contained HTML file that shows report_data(). It loads nothing from elsewhere, and text in the data is
/// never interpreted as markup.
std::string report_page(const Json& data);

}  // namespace isojam
