#include "tasks/extras/report/report_page.hpp"

#include "tasks/extras/page/page.hpp"

namespace isojam {

std::string report_page(std::string_view data) { return assembled_page(report_parts(), data); }

}  // namespace isojam
