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
Json solids_of(const ExportArguments& arguments, const std::vector<std::string>& names,
               const std::optional<Plan>& plan) {
  Json solids = Json::object();
  for (const auto& name : names) {
    const auto held = own_record(arguments, plan, name);
    for (const auto& kind : held.summary.solid.kinds()) {
      Json& solid = solids[kind.solid->name()];
      if (!solid.is_null()) continue;
      for (const auto& v : kind.solid->vertices()) solid["vertices"].push_back({v[0], v[1], v[2]});
      for (const auto& face : kind.solid->faces()) solid["faces"].push_back(face.vertices);
    }
  }
  return solids;
}

}  // namespace

ExitCode export_rows(const ExportArguments& arguments, Console& console) {
  // If a name is unknown, this throws before the first line is written.
  const auto names = chosen_names(arguments);
  const auto manifest = stored_manifest(arguments.directory);
  const auto plan = manifest ? std::optional<Plan>(*manifest) : std::nullopt;
  if (arguments.what == Exported::solids) {
    Output output(arguments.output);
    output.append(pretty(solids_of(arguments, names, plan)));
    output.finish();
    return ExitCode::done;
  }
  const auto format = format_of(arguments.output);
  const auto of = arguments.what == Exported::states ? RowOf::state : RowOf::replicate;
  const RecordRows rows(of, format, manifest, own_record(arguments, plan, names.front()));
  const bool of_contacts = arguments.what == Exported::contacts;
  Output output(arguments.output);
  output.append(of_contacts ? head_line(format, contact_columns()) : rows.head());
  for (const auto& name : names) {
    const auto held = own_record(arguments, plan, name);
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
