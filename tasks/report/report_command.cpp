#include "tasks/report/report_command.hpp"

#include <cstdio>
#include <filesystem>
#include <map>

#include "tasks/atomic_file.hpp"
#include "tasks/report/gather.hpp"
#include "tasks/report/page.hpp"

namespace isojam {

ExitCode report(const ReportCommand& command) {
  const std::filesystem::path directory = command.directory;
  const auto output = command.output.empty() ? directory / "report.html" : std::filesystem::path(command.output);
  const auto results = read_results(directory);
  const ViewOptions options;
  std::map<std::size_t, Json> views;
  for (const auto& chosen : choose_views(results, options)) {
    const auto packing = read_nearest_packing(directory, results.replicates[chosen.replicate].name);
    if (packing) views[chosen.replicate] = packing_view(*packing, chosen.with_modes ? options.modes : 0);
  }
  Json data = report_data(results, views);
  // A link that is there for a reader of the directory alone: the page may be sent elsewhere without it.
  data["chart"] = std::filesystem::exists(output.parent_path() / "chart.html");
  write_atomically(output, report_page(data));
  std::printf("%s\n", output.string().c_str());
  return ExitCode::done;
}

}  // namespace isojam
