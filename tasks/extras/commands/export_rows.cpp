#include <optional>

#include "tasks/extras/commands/export.hpp"
#include "tasks/extras/export/contact_network.hpp"
#include "tasks/extras/export/record_rows.hpp"
#include "tasks/extras/export/stored_states.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/records/store.hpp"

namespace isojam {
namespace {

/// Output to a file, or to standard output if no file is named.
class Output {
 public:
  explicit Output(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  void append(const std::string& text) {
    if (file_) return file_->append(text);
    print(text);
  }
  void finish() {
    if (file_) file_->finish();
  }

 private:
  std::optional<OutputWriter> file_;
};

RowFormat format_of(const std::string& output) {
  return output.ends_with(".jsonl") ? RowFormat::json_lines : RowFormat::csv;
}

/// Appends the contacts of a replicate, one state at a time because a decompression can have millions of contacts.
void append_contacts(const ExportArguments& arguments, const RecordedReplicate& held, Output& output) {
  for (const auto& state : stored_states(arguments.directory, held, arguments.path)) {
    output.append(contact_lines(format_of(arguments.output), held.name, state));
  }
}

/// The solids of these replicates: {name: {"vertices": [[x, y, z], …], "faces": [[index, …], …]}, …}.
Json solids_of(const ExportArguments& arguments, const std::vector<std::string>& names, const Requests& requests) {
  Json solids = Json::object();
  for (const auto& name : names) {
    const auto held = own_record(arguments, requests, name);
    for (const auto& kind : held.summary.solid.kinds()) {
      Json& solid = solids[kind.solid->name()];
      if (!solid.is_null()) continue;
      for (const auto& v : kind.solid->vertices()) solid["vertices"].push_back({v[0], v[1], v[2]});
      for (const auto& face : kind.solid->faces()) solid["faces"].push_back(face.vertices);
    }
  }
  return solids;
}

/// A manifest with the parameters, solids and measures of all manifests of a directory.
std::optional<Manifest> combined(const Requests& requests) {
  if (requests.empty()) return std::nullopt;
  auto all = requests.front().manifest();
  for (const auto& plan : requests) {
    const auto& more = plan.manifest();
    all.swept.insert(more.swept.begin(), more.swept.end());
    all.solids.insert(all.solids.end(), more.solids.begin(), more.solids.end());
    all.measures.insert(all.measures.end(), more.measures.begin(), more.measures.end());
  }
  sort_measures(all.measures);
  return all;
}

}  // namespace

ExitCode export_rows(const ExportArguments& arguments, Console& console) {
  // If a name is unknown, this throws before the first line is written.
  const auto names = chosen_names(arguments);
  const auto requests = requests_in(arguments.directory, [&](const std::string& message) { console.warn(message); });
  if (arguments.what == Exported::solids) {
    Output output(arguments.output);
    output.append(pretty(solids_of(arguments, names, requests)));
    output.finish();
    return ExitCode::done;
  }
  const auto format = format_of(arguments.output);
  const auto of = arguments.what == Exported::states ? RowOf::state : RowOf::replicate;
  const bool of_contacts = arguments.what == Exported::contacts;
  std::optional<Abridgement> kept;
  if (!of_contacts) kept = {of == RowOf::state ? States::all : States::nearest, Keys::all};
  const RecordRows rows(of, format, combined(requests), own_record(arguments, requests, names.front(), kept));
  Output output(arguments.output);
  output.append(of_contacts ? head_line(format, contact_columns()) : rows.head());
  for (const auto& name : names) {
    const auto held = own_record(arguments, requests, name, kept);
    if (!of_contacts) {
      output.append(rows.lines(held));
    } else if (has_packing(arguments, held, console)) {
      append_contacts(arguments, held, output);
    }
  }
  output.finish();
  return ExitCode::done;
}

}  // namespace isojam
