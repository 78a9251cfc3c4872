#include "tasks/commands/chart/chart.hpp"

#include <memory>

namespace isojam {

void add_chart(CLI::App& app, Session& session) {
  const auto arguments = std::make_shared<ChartArguments>();
  auto options =
      add_command(app, session, "chart", "Compare methods on this machine: accuracy against speed, and what fails",
                  [arguments, &session](Console& console) { return chart(*arguments, session, console); });
  options.text("config", arguments->config, "What to compare (default: five minutes of everything)", "CONFIG");
  options.flag("--full", arguments->full, "An hour of everything");
  options.exclusive("--full", "config");
  options.text("-o,--output", arguments->directory, "Directory for data.json, table.txt and chart.html", "DIR",
               Options::Need::required);
}

}  // namespace isojam
