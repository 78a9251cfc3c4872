#include "tasks/commands/shared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include "engine/arithmetic/fma.hpp"
#include "tasks/io/place.hpp"
#include "tasks/io/standard_streams.hpp"
#include "tasks/io/usage_error.hpp"
#include "tasks/io/version.hpp"
#include "tasks/manifest/warnings.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/store.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {

void warn_about(const Manifest& manifest, const std::string& file, Console& console) {
  for (const auto& warning : warnings_of(manifest)) console.warn(fmt::format("{}: {}", file, warning));
}

std::string definitions_text(const Manifest& manifest) {
  std::string text;
  for (const auto& [name, definition] : manifest.definitions)
    text += fmt::format("{}: {}\n", name, definition_text(definition));
  for (std::size_t k = 0; manifest.start && k < manifest.start->files.size(); ++k) {
    const auto& file = manifest.start->files[k];
    if (file.packing)
      text += fmt::format("{}: {} particles, density {:.6g}, deepest overlap {:.2g} of the volume of a particle\n",
                          file.path, file.packing->size(), manifest.start->density.value_or(file.packing->density()),
                          file.deepest_overlap);
  }
  return text;
}

void warn_without_fma(Console& console) {
  if (!has_fma())
    console.warn(
        "this processor has no fused multiply-add (FMA), so the program is more than 25 times slower, with the "
        "same results; use a processor from 2013 or later");
}

std::string step_text(const ReplicateSpec& spec, const JamProgress& progress) {
  const auto& step = progress.result.path.back();
  return fmt::format("{}: {} at density {:.4f}, energy per particle {:.1e}, residual {:.1e}", replicate_name(spec),
                     to_string(step.stage), step.density, step.energy_per_particle, step.summary.residual);
}

std::vector<std::string> recorded_names(const std::string& directory) {
  auto names = names_in(std::filesystem::path(directory) / "records");
  if (names.empty()) throw_without_records(directory);
  return names;
}

std::string recorded_name(const std::string& directory, const std::string& name) {
  const auto names = recorded_names(directory);
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  throw_unknown_replicate(directory, name, names);
}

void throw_unknown_replicate(const std::string& directory, const std::string& name,
                             const std::vector<std::string>& names) {
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  const auto nearest = nearest_name(name, candidates);
  const auto correction = names.empty()     ? std::string()
                          : nearest.empty() ? fmt::format("; expected a name such as \"{}\"", names[0])
                                            : fmt::format("; did you mean \"{}\"?", nearest);
  throw UsageError(fmt::format("{}: unknown replicate \"{}\"{}", directory, name, correction));
}

void print_tables(const Table& table, const std::string& directory, const std::vector<Measure>& measures) {
  const auto how = fmt::format("\"isojam aggregate {} --all\"", directory);
  print(to_text(table, View::nearest, {false, output_columns(), how, measures}));
}

std::string version_text() {
  return fmt::format("isojam {} ({})\nfile formats written by this version: {} {} {} {}", version(), git_hash(),
                     record_schema, packing_schema, path_schema, table_schema);
}

std::string shell_argument(const std::string& path) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-./+:@%=,").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!path.empty() && std::all_of(path.begin(), path.end(), is_plain)) return path;
  std::string text = "'";
  for (const char c : path) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

std::string counted(std::size_t number, std::string_view noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

std::string bytes_text(double bytes) {
  static constexpr std::array units{"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < units.size(); ++unit) bytes /= 1000;
  return fmt::format("{:.{}f} {}", bytes, unit > 0 && bytes < 9.95 ? 1 : 0, units[unit]);
}

}  // namespace isojam
