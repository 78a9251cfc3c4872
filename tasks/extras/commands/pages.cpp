#include "tasks/extras/commands/pages.hpp"

#include "tasks/commands/shared.hpp"
#include "tasks/extras/commands/extra_commands.hpp"
#ifdef ISOJAM_PAGES
#include "tasks/extras/chart/data.hpp"
#endif

namespace isojam {
namespace {

#ifdef ISOJAM_PAGES
constexpr auto write_report = report;
constexpr auto write_chart = chart;
#else
template <class Arguments>
ExitCode refuse(const Arguments&, Console& console) {
  console.error(
      "this build has neither report nor chart: Vega or three.js was missing when it was configured; install "
      "libjs-vega and libjs-three (or set ISOJAM_JAVASCRIPT), configure with -DISOJAM_PAGES=ON and build again");
  return ExitCode::usage;
}
constexpr auto write_report = refuse<ReportArguments>;
constexpr auto write_chart = refuse<ChartArguments>;
#endif

}  // namespace

void add_report(CLI::App& app, Session& session) {
  ReportArguments* arguments = nullptr;
  auto options = add_command(app, session, "report", "Write an interactive HTML report of results directories",
                             write_report, arguments);
  options.texts("directories", arguments->directories, "Results directories", "DIR");
  options.text("-o,--output", arguments->output,
               "Output file (default: DIR/report.html; required for several directories)", "FILE");
}

void add_chart(CLI::App& app, Session& session) {
#ifdef ISOJAM_PAGES
  documents().push_back({"chart", "Configuration of isojam chart", fields_of<ChartConfig>});
  documents().push_back({"chart_data", "Data of isojam chart", fields_of<ChartData>});
#endif
  ChartArguments* arguments = nullptr;
  auto options = add_command(app, session, "chart", "Compare methods on this machine: accuracy, speed and failures",
                             write_chart, arguments);
  options.text("config", arguments->config,
               "Configuration of the comparison (default: all comparisons in five minutes)", "CONFIG");
  options.flag("--full", arguments->full, "Make all comparisons in detail, in about an hour (without CONFIG)");
  options.text("-o,--output", arguments->directory, "Output directory for data.json, table.txt and chart.html", "DIR",
               Options::Need::required);
}

}  // namespace isojam
