#include <filesystem>
#include <map>

#include "tasks/extras/commands/pages.hpp"
#include "tasks/extras/report/gather.hpp"
#include "tasks/extras/report/report_page.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/standard_streams.hpp"

namespace isojam {

ExitCode report(const ReportArguments& arguments, Console& console) {
  const std::filesystem::path directory = arguments.directory;
  const auto output = arguments.output.empty() ? directory / "report.html" : std::filesystem::path(arguments.output);
  const auto results = read_results(directory, [&](const std::string& message) { console.warn(message); });
  const ViewOptions options;
  std::map<std::size_t, Json> views;
  const auto choice = choose_views(results, options);
  for (const auto& chosen : choice) {
    const auto packing = read_nearest_packing(directory, results.replicates[chosen.replicate]);
    if (!packing) continue;
    views[chosen.replicate] = packing_view(*packing, chosen.with_modes ? options.modes : 0);
    views[chosen.replicate]["solid"] = to_string(results.replicates[chosen.replicate].summary.solid);
  }
  Json data = report_data(results, views);
  data["viewable"] = {{"most_particles", options.most_particles}, {"chosen", choice.size()}};
  // The page links to a chart in the same folder. The link does not work if the page is sent to somebody alone.
  data["chart"] = std::filesystem::exists(output.parent_path() / "chart.html");
  write_output(output, report_page(data));
  print(output.string() + "\n");
  return ExitCode::done;
}

}  // namespace isojam
