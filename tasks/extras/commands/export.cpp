#include "tasks/extras/commands/export.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "tasks/commands/shared.hpp"
#include "tasks/extras/commands/extra_commands.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/usage_error.hpp"
#include "tasks/records/failure_text.hpp"
#include "tasks/records/store.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

bool is_of_packings(Exported what) { return what == Exported::gsd || what == Exported::vtp || what == Exported::xyz; }

/// Throws if an option has no effect on the chosen format.
void check_options(const ExportArguments& arguments) {
  const auto format = to_string(arguments.what);
  if (is_of_packings(arguments.what) && arguments.output.empty())
    throw UsageError(
        fmt::format("--format {} needs an output; give a file with -o, or a directory for all replicates", format));
  if (arguments.path && !is_of_packings(arguments.what) && arguments.what != Exported::contacts)
    throw UsageError(
        fmt::format("--path cannot be combined with --format {}; use it with packings or contacts", format));
  if (arguments.contacts && arguments.what != Exported::gsd && arguments.what != Exported::vtp)
    throw UsageError("--contacts needs --format gsd or vtp; use --format contacts for a table of contacts");
}

ExitCode export_results(const ExportArguments& arguments, Console& console) {
  check_options(arguments);
  return is_of_packings(arguments.what) ? export_packings(arguments, console) : export_rows(arguments, console);
}

std::string record_file(const ExportArguments& arguments, const std::string& name) {
  return (fs::path(arguments.directory) / "records" / (name + ".json")).string();
}

}  // namespace

std::vector<std::string> chosen_names(const ExportArguments& arguments) {
  if (arguments.all()) return recorded_names(arguments.directory);
  return {recorded_name(arguments.directory, arguments.replicate)};
}

RecordedReplicate own_record(const ExportArguments& arguments, const Requests& requests, const std::string& name,
                             const std::optional<Abridgement>& kept) {
  auto held = read_record(arguments.directory, name, kept);
  const auto spec = requested(requests, name);
  const auto digest = spec ? std::optional(spec_digest(*spec)) : std::nullopt;
  if (!requests.empty() && standing_of(held, digest) == Standing::foreign)
    throw InputError({record_file(arguments, name), "/provenance/spec_digest", std::string(other_manifest),
                      digest.value_or(""), ""});
  return held;
}

bool has_packing(const ExportArguments& arguments, const RecordedReplicate& held, Console& console) {
  if (!held.summary.failed) return true;
  const auto message =
      fmt::format("{} has no packing, because the replicate failed: {}", held.name, failure_text(held.record));
  if (!arguments.all()) throw UsageError(message);
  console.warn(message);
  return false;
}

void add_export(CLI::App& app, Session& session) {
  ExportArguments* arguments = nullptr;
  auto options = add_command(app, session, "export",
                             "Export packings (GSD, VTP, XYZ), a table of contacts, replicates or states, or solids",
                             export_results, arguments);
  options.results_directory(arguments->directory);
  options.text("replicate", arguments->replicate, "Name of the replicate (its file in records/ without .json), or all",
               "REPLICATE", Options::Need::required);
  options.choice("--format", arguments->what,
                 "Format of the packings (gsd, vtp, xyz), table to export (contacts, replicates, states), or shapes of "
                 "the solids as JSON (solids)",
                 Options::Need::required);
  options.text(
      "-o,--output", arguments->output,
      "Packings: output file, or a directory for all replicates. Tables and solids: output file (default: standard "
      "output); a table is JSON lines if the name ends in .jsonl, otherwise CSV",
      "FILE");
  options.flag("--path", arguments->path, "Export all states of the decompression (needs keep_path in the manifest)");
  options.flag("--contacts", arguments->contacts,
               "Also export the contact network: as bonds in GSD, or as line segments in a second VTP file");
}

}  // namespace isojam
