#pragma once

#include <string>

#include "tasks/json/json.hpp"

namespace isojam {

/// One self-contained HTML file that shows report_data(): nothing is fetched, and no text of the data is ever markup.
std::string report_page(const Json& data);

}  // namespace isojam
