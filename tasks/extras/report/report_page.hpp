#pragma once

#include <string>

#include "tasks/io/json.hpp"

namespace isojam {

/// Makes the HTML file of a report. `data` is the result of report_data(). The file is self-contained: it loads no
/// other files. Text in `data` is never interpreted as HTML.
std::string report_page(const Json& data);

}  // namespace isojam
