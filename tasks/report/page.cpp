#include "tasks/report/page.hpp"

#include "tasks/page/page.hpp"

namespace isojam {

std::string report_page(const Json& data) { return assembled_page(report_parts(), data); }

}  // namespace isojam
