#include "tasks/commands/shared.hpp"

#include <fmt/format.h>

#include <array>

#include "tasks/manifest/warnings.hpp"

namespace isojam {

void warn_about(const Manifest& manifest, const std::string& file, Console& console) {
  for (const auto& warning : warnings_of(manifest)) console.warn(fmt::format("{}: {}", file, warning));
}

std::string step_text(const ReplicateSpec& spec, const JamProgress& progress) {
  const auto& step = progress.result.path.back();
  return fmt::format("{}: {} at density {:.4f}, E/N {:.1e}, residual {:.1e}", replicate_name(spec),
                     to_string(step.stage), step.density, step.energy_per_particle, step.summary.residual);
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
