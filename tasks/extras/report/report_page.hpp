#pragma once

#include <string>
#include <string_view>

namespace isojam {

/// Makes the HTML file of a report. `data` is the text of ReportData::text(). The file is self-contained: it loads no
/// other files. Text in `data` is never interpreted as HTML.
std::string report_page(std::string_view data);

}  // namespace isojam
