#include <filesystem>
#include <iterator>
#include <map>
#include <utility>

#include "tasks/extras/commands/pages.hpp"
#include "tasks/extras/report/gather.hpp"
#include "tasks/extras/report/report_page.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/standard_streams.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;

/// The results of all directories, and for each replicate the directory from which it comes.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Gathered {
  Results results;
  std::vector<fs::path> origins;
};

/// Adds the manifest of one more directory. Means need one list of excluded flags.
void add_manifest(Json& all, const Json& more, const std::string& directory) {
  if (all.is_null() || more.is_null()) return;
  if (all.at("exclude") != more.at("exclude"))
    throw InputError({(fs::path(directory) / "manifest.json").string(), "/exclude",
                      "differs from that of the first directory", "", "",
                      "set the same value in the manifests and run them again, which only updates the tables"});
  if (all.at("name") != more.at("name"))
    all["name"] = all.at("name").get<std::string>() + " + " + more.at("name").get<std::string>();
  if (all.at("seed") != more.at("seed")) all.erase("seed");
  if (all.at("keep_path") != more.at("keep_path")) all["keep_path"] = false;
}

Gathered gathered(const std::vector<std::string>& directories, const Warn& warn) {
  Gathered all;
  for (const auto& directory : directories) {
    auto more = read_results(directory, warn);
    if (&directory == &directories.front()) {
      all.results.manifest = std::move(more.manifest);
    } else {
      add_manifest(all.results.manifest, more.manifest, directory);
    }
    all.origins.insert(all.origins.end(), more.replicates.size(), directory);
    std::move(more.replicates.begin(), more.replicates.end(), std::back_inserter(all.results.replicates));
  }
  return all;
}

}  // namespace

ExitCode report(const ReportArguments& arguments, Console& console) {
  const bool several = arguments.directories.size() > 1;
  if (several && arguments.output.empty()) {
    console.error("a report of several directories needs -o FILE");
    return ExitCode::usage;
  }
  const auto output =
      arguments.output.empty() ? fs::path(arguments.directories.front()) / "report.html" : fs::path(arguments.output);
  auto [results, origins] = gathered(arguments.directories, [&](const std::string& message) { console.warn(message); });
  const ViewOptions options;
  std::map<std::size_t, Json> views;
  const auto choice = choose_views(results, options);
  for (const auto& chosen : choice) {
    const auto packing = read_nearest_packing(origins[chosen.replicate], results.replicates[chosen.replicate]);
    if (!packing) continue;
    views[chosen.replicate] = packing_view(*packing, chosen.with_modes ? options.modes : 0);
    views[chosen.replicate]["solid"] = to_string(results.replicates[chosen.replicate].summary.solid);
  }
  // Replicates of two directories may have the same name.
  for (std::size_t k = 0; several && k < origins.size(); ++k)
    results.replicates[k].name = (origins[k] / results.replicates[k].name).string();
  Json data = report_data(results, views);
  data["viewable"] = {{"most_particles", options.most_particles}, {"chosen", choice.size()}};
  // The page links to a chart in the same folder. The link does not work if the page is sent to somebody alone.
  data["chart"] = fs::exists(output.parent_path() / "chart.html");
  write_output(output, report_page(data));
  print(output.string() + "\n");
  return ExitCode::done;
}

}  // namespace isojam
