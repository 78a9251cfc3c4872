#include <filesystem>
#include <system_error>

#include "tasks/commands/shared.hpp"
#include "tasks/extras/chart/data.hpp"
#include "tasks/extras/chart/run_chart.hpp"
#include "tasks/extras/commands/pages.hpp"
#include "tasks/extras/page/page.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/interrupt.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/usage_error.hpp"

namespace isojam {
namespace {

ChartConfig config_of(const ChartArguments& arguments) {
  if (arguments.full && !arguments.config.empty())
    throw UsageError("CONFIG and --full cannot be combined; remove one of them");
  if (!arguments.config.empty()) return parse_chart_config(read_text(arguments.config), arguments.config);
  return arguments.full ? full_chart_config() : ChartConfig();
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw FileError::of_error(directory, "cannot be created", error);
  check_writable(directory);
}

std::string written(const ChartConfig& config, const ChartResult& result, const std::filesystem::path& directory) {
  const Json data = chart_data(config, result);
  auto table = text_table(result);
  write_atomically(directory / "data.json", pretty(data));
  write_atomically(directory / "table.txt", table);
  write_atomically(directory / "chart.html", assembled_page(chart_parts(), page_text(data)));
  return table;
}

}  // namespace

ExitCode chart(const ChartArguments& arguments, Console& console) {
  const ChartConfig config = config_of(arguments);
  const std::filesystem::path directory = arguments.directory;
  make_directory(directory);
  const InterruptWatcher watcher;
  warn_without_fma(console);
  // The files are written after each part, because the watcher ends a process that does not stop in time.
  const auto result = run_chart(config, watcher.token(), console,
                                [&](const ChartResult& so_far) { written(config, so_far, directory); });
  console.end();
  const auto table = written(config, result, directory);
  print(table);
  return watcher.token().stop_requested() ? ExitCode::interrupted : ExitCode::done;
}

}  // namespace isojam
