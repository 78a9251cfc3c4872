#include <filesystem>
#include <tuple>
#include <vector>

#include "tasks/extras/commands/pages.hpp"
#include "tasks/extras/page/page.hpp"
#include "tasks/extras/report/gather.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/records/store.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;

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

Json manifest_of(const std::vector<std::string>& directories) {
  Json all;
  for (const auto& directory : directories) {
    const auto manifest = stored_manifest(directory);
    const auto more = manifest ? to_json(*manifest) : Json();
    if (&directory == &directories.front()) {
      all = more;
    } else {
      add_manifest(all, more, directory);
    }
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
  ReportData data(manifest_of(arguments.directories));
  std::vector<fs::path> origins;
  for (const fs::path directory : arguments.directories) {
    for_each_record(
        directory, [&](const std::string& message) { console.warn(message); },
        [&](const RecordedReplicate& held) {
          // Replicates of two directories may have the same name.
          data.add(held, several ? (directory / held.name).string() : held.name);
          origins.push_back(directory);
        });
  }
  const ViewOptions options;
  std::vector<std::string> views;
  const auto choice = choose_views(data.viewable(), options);
  for (const auto& chosen : choice) {
    const auto& [name, directory] = std::tie(data.viewable()[chosen.replicate].name, origins[chosen.replicate]);
    const auto held = read_record(directory, fs::path(name).filename().string(), Abridgement{States::nearest});
    const auto packing = read_nearest_packing(directory, held);
    if (!packing) continue;
    auto view = packing_view(*packing, chosen.with_modes ? options.modes : 0, held.gap());
    view["solid"] = to_string(held.summary.solid);
    view["name"] = name;
    views.push_back(page_text(view));
  }
  // The page links to a chart in the same folder. The link does not work if the page is sent to somebody alone.
  const Json more{{"viewable", {{"most_particles", options.most_particles}, {"chosen", choice.size()}}},
                  {"chart", fs::exists(output.parent_path() / "chart.html")}};
  write_output(output, assembled_page(report_parts(), data.text(views, more)));
  print(output.string() + "\n");
  return ExitCode::done;
}

}  // namespace isojam
