#include "tasks/commands/pages.hpp"

#include "tasks/commands/command.hpp"

namespace isojam {
namespace {

#ifdef ISOJAM_PAGES
constexpr auto write_report = report;
constexpr auto write_chart = chart;
#else
template <class Arguments>
ExitCode refuse(const Arguments&, Console& console) {
  console.error(
      "this build has neither `report` nor `chart`, because Vega or three.js was missing when it was configured; "
      "install libjs-vega and libjs-three (or set ISOJAM_JAVASCRIPT), configure again with -DISOJAM_PAGES=ON and "
      "build");
  return ExitCode::usage;
}
constexpr auto write_report = refuse<ReportArguments>;
constexpr auto write_chart = refuse<ChartArguments>;
#endif

}  // namespace

void add_report(CLI::App& app, Session& session) {
  ReportArguments* arguments = nullptr;
  auto options = add_command(app, session, "report", "Write a results directory as one interactive HTML file",
                             write_report, arguments);
  options.results_directory(arguments->directory);
  options.text("-o,--output", arguments->output, "File to write (default: DIR/report.html)", "FILE");
}

void add_chart(CLI::App& app, Session& session) {
  ChartArguments* arguments = nullptr;
  auto options =
      add_command(app, session, "chart", "Compare methods on this machine: accuracy against speed, and what fails",
                  write_chart, arguments);
  options.text("config", arguments->config, "What to compare (default: five minutes of everything)", "CONFIG");
  options.flag("--full", arguments->full, "An hour of everything");
  options.exclusive("--full", "config");
  options.text("-o,--output", arguments->directory, "Directory for data.json, table.txt and chart.html", "DIR",
               Options::Need::required);
}

}  // namespace isojam
