#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "tasks/extras/commands/export.hpp"
#include "tasks/extras/export/stored_states.hpp"
#include "tasks/io/atomic_file.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/usage_error.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

std::string extension_of(const ExportArguments& arguments) {
  const bool collection = arguments.what == Exported::vtp && arguments.path;
  return collection ? ".pvd" : "." + std::string(to_string(arguments.what));
}

void warn_of_undecided(const std::string& name, const std::vector<ExportFrame>& frames, Console& console) {
  const auto undecided = std::count_if(frames.begin(), frames.end(), [](const ExportFrame& frame) {
    return frame.cluster.front() == ExportFrame::undecided_cluster;
  });
  if (undecided == 0) return;
  console.warn(fmt::format("{}: contacts cannot be classified in {} of {} states, so these have no clusters", name,
                           undecided, frames.size()));
}

/// If the output is a stream, it receives only the file that the user named, without accompanying files.
void export_replicate(const ExportArguments& arguments, const Requests& requests, const std::string& name,
                      const fs::path& output, Console& console) {
  const auto held = own_record(arguments, requests, name);
  if (!has_packing(arguments, held, console)) return;
  std::vector<ExportFrame> frames;
  for (auto& state : stored_states(arguments.directory, held, arguments.path))
    frames.push_back(make_frame(std::move(state.packing), state.delta_phi, arguments.contacts, state.gap));
  warn_of_undecided(name, frames, console);
  auto files = exported_files(frames, arguments.what, arguments.path, output);
  if (is_stream(output)) std::erase_if(files, [&](const ExportedFile& file) { return file.path != output; });
  if (files.empty())
    throw UsageError(
        fmt::format("{}: several files cannot be written to a stream; choose a regular file", output.string()));
  for (const auto& exported : files) {
    write_output(exported.path, exported.bytes);
    print(exported.path.string() + "\n");
  }
}

}  // namespace

ExitCode export_packings(const ExportArguments& arguments, Console& console) {
  const auto names = chosen_names(arguments);
  const auto requests = requests_in(arguments.directory, [&](const std::string& message) { console.warn(message); });
  if (!arguments.all()) {
    export_replicate(arguments, requests, names.front(), arguments.output, console);
    return ExitCode::done;
  }
  std::error_code error;
  if (fs::exists(arguments.output, error) && !fs::is_directory(arguments.output, error))
    throw UsageError(arguments.output + " is a file; give a directory for the files of all replicates");
  fs::create_directories(arguments.output, error);
  if (error) throw FileError::of_error(arguments.output, "cannot be created", error);
  for (const auto& name : names) {
    const auto output = fs::path(arguments.output) / (name + extension_of(arguments));
    export_replicate(arguments, requests, name, output, console);
  }
  return ExitCode::done;
}

}  // namespace isojam
