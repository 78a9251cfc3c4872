#include "tasks/commands/export/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "tasks/commands/command.hpp"
#include "tasks/commands/shared.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/store/store.hpp"
#include "tasks/system/file.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

bool is_table(Exported what) {
  return what == Exported::contacts || what == Exported::replicates || what == Exported::states;
}

/// Refuses options that have no meaning for the chosen export.
void check_options(const ExportArguments& arguments) {
  const auto format = to_string(arguments.what);
  if (!is_table(arguments.what) && arguments.output.empty())
    throw FileError(fmt::format("-o is needed with --format {}: the file to write, or the directory of all", format));
  if (arguments.path && (arguments.what == Exported::replicates || arguments.what == Exported::states))
    throw FileError(
        fmt::format("--path goes with packings and contacts, and --format {} has every state of a record", format));
  if (arguments.contacts && arguments.what != Exported::gsd && arguments.what != Exported::vtp)
    throw FileError("--contacts goes with --format gsd or vtp; --format contacts is the table of contacts");
}

ExitCode export_results(const ExportArguments& arguments, Console& console) {
  check_options(arguments);
  return is_table(arguments.what) ? export_rows(arguments, console) : export_packings(arguments, console);
}

/// nullopt if the replicate did not fail.
std::optional<std::string> failure_text(const JsonPlace& record) {
  if (record.at("status").choice(std::array<std::string_view, 2>{"done", "failed"}) == 0) return std::nullopt;
  const auto failure = record.at("failure");
  return fmt::format("failed in {}: {}", failure.at("where").text(), failure.at("why").text());
}

std::string record_file(const ExportArguments& arguments, const std::string& name) {
  return (fs::path(arguments.directory) / "records" / (name + ".json")).string();
}

}  // namespace

std::vector<std::string> chosen_names(const ExportArguments& arguments) {
  if (arguments.all()) return recorded_names(arguments.directory);
  return {recorded_name(arguments.directory, arguments.replicate)};
}

RecordedReplicate own_record(const ExportArguments& arguments, const std::optional<Manifest>& manifest,
                             const std::string& name) {
  auto held = read_record(arguments.directory, name);
  if (manifest && !is_of(held, *manifest))
    throw InputError({record_file(arguments, name), "/provenance/manifest_digest",
                      "belongs to another manifest than the directory", "", ""});
  return held;
}

bool has_packing(const ExportArguments& arguments, const RecordedReplicate& held, Console& console) {
  const auto failure = failure_text({held.record, record_file(arguments, held.name)});
  if (!failure) return true;
  const auto message = fmt::format("{} {}; it has no packing", held.name, *failure);
  if (!arguments.all()) throw FileError(message);
  console.warn(message);
  return false;
}

void add_export(CLI::App& app, Session& session) {
  ExportArguments* arguments = nullptr;
  auto options = add_command(app, session, "export",
                             "Write packings for HOOMD-blue and OVITO, ParaView, or as text; contacts, replicates and "
                             "states as tables",
                             export_results, arguments);
  options.results_directory(arguments->directory);
  options.text("replicate", arguments->replicate, "Name of a replicate, as its record's file has it, or all",
               "REPLICATE", Options::Need::required);
  options.choice("--format", arguments->what, "Format of the files, or what the rows of a table are",
                 Options::Need::required);
  options.text("-o,--output", arguments->output,
               "File to write; of packings of all replicates, the directory for them; of a table, by default, standard "
               "output (CSV; JSON lines where the name ends in .jsonl)",
               "FILE");
  options.flag("--path", arguments->path, "Every state of the expansion (of manifests with keep_path)");
  options.flag("--contacts", arguments->contacts,
               "With the network of contacts: bonds in GSD, lines in a file of their own beside VTP");
}

}  // namespace isojam
