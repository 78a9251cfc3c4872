#include "tasks/manifest/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "tasks/io/file.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/manifest/base.hpp"
#include "tasks/manifest/by_solid.hpp"
#include "tasks/manifest/cohesion.hpp"
#include "tasks/manifest/particles.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {
namespace {

constexpr double most_replicates_in_all = 1e6;
/// Largest number of states of a shear; nobody would plot more.
constexpr double most_shear_steps = 10000;

/// Throws if a manifest from a results directory was changed after isojam wrote it. Without the key `checksum`, the
/// file counts as a user's manifest and may be changed.
void check_own_seal(std::string_view text, const std::string& file) {
  try {
    check_seal(text, file);
  } catch (const InputError&) {
    throw InputError({file, "/checksum", "the file was changed after isojam wrote it", "", "",
                      "restore it, or remove the checksum to use it as a manifest of your own"});
  }
}

void check_swept(const JsonPlace& root, const Manifest& manifest) {
  for (const auto& [name, values] : manifest.swept) {
    std::vector<std::string> pointers{find_parameter(name)->pointer};
    for (const auto& [solid, own] : manifest.by_solid)
      pointers.push_back("/protocol/by_solid/" + std::string(solid) + "/" + name);
    for (const auto& pointer : pointers) {
      const auto place = place_at(root, pointer);
      if (!place) continue;
      place->attempt([&, &key = name] {
        place->refuse_with_remedy("the parameter is also swept",
                                  fmt::format("set it either here or in /sweep/{}", key));
      });
    }
  }
}

void check_replicates(const JsonPlace& root, const Manifest& manifest) {
  const auto& [min, max, goal] = manifest.replicates;
  if (goal && max < min && root.is_sound("/replicates/min") && root.is_sound("/replicates/max"))
    root.at("replicates").at("max").not_accepted(integer_in({static_cast<double>(min), most_replicates}));
}

void check_goal(const JsonPlace& root, const Manifest& manifest) {
  const auto& goal = manifest.replicates.goal;
  if (!goal || !root.is_sound("/replicates/quantity") || !root.is_sound("/measure")) return;
  const auto needed = all_quantities()[*quantity_index(goal->quantity)].measure;
  const auto& measures = manifest.measures;
  if (!needed || std::find(measures.begin(), measures.end(), *needed) != measures.end()) return;
  root.at("replicates")
      .at("quantity")
      .refuse_with_remedy(fmt::format("{} is not measured", goal->quantity),
                          fmt::format("add \"{}\" to /measure", to_string(*needed)));
}

void check_shear(const JsonPlace& root, const ShearOptions& options) {
  if (!root.is_sound("/shear") || (options.step <= options.until && options.until <= most_shear_steps * options.step))
    return;
  const auto place = root.at("shear");
  const bool is_short = options.until < options.step;
  place.at(place.has("until") ? "until" : "step")
      .refuse_with_remedy(is_short ? fmt::format("until {} is less than step {}", options.until, options.step)
                                   : fmt::format("until {} needs more than {:.0f} steps of {}", options.until,
                                                 most_shear_steps, options.step),
                          is_short ? "increase until or decrease step" : "decrease until or increase step");
}

void check_count(const JsonPlace& root, const Manifest& manifest) {
  double count = static_cast<double>(manifest.solids.size() * manifest.particles.size());
  for (const auto& [name, values] : manifest.swept) count *= static_cast<double>(values.size());
  count *= std::max(1, manifest.replicates.max);
  if (count > most_replicates_in_all) {
    root.at("sweep").refuse(fmt::format("the sweep has {:.0f} replicates", count),
                            fmt::format("at most {:.0f}", most_replicates_in_all));
  }
}

void check_densities(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets) {
  for (const auto& mixture : manifest.solids) {
    for (const auto& set : sets) {
      const auto compression = options_of(manifest, set, mixture).compression;
      if (compression.initial_density < compression.max_density) continue;
      const auto place = place_of(root, "initial_density", to_string(mixture));
      const auto limit = place_of(root, "max_density", to_string(mixture));
      const auto& at = place.pointer().empty() ? limit : place;
      at.attempt([&] {
        at.refuse_with_remedy(fmt::format("initial_density {} is not below max_density {}", compression.initial_density,
                                          compression.max_density),
                              "decrease initial_density or increase max_density");
      });
    }
  }
}

/// Checks conditions that involve several values. A condition is checked if there is no error at its values.
void check_together(const JsonPlace& root, const Manifest& manifest) {
  check_swept(root, manifest);
  root.attempt([&] { check_replicates(root, manifest); });
  root.attempt([&] { check_goal(root, manifest); });
  root.attempt([&] { check_shear(root, manifest.measuring.shear); });
  if (!root.is_sound("/sweep")) return;
  if (root.is_sound("/base"))
    root.read_if_any("base", [&](const JsonPlace& place) { check_base(place, manifest.base, swept_values(manifest)); });
  // If there are too many combinations, do not make them.
  if (!root.attempt([&] { check_count(root, manifest); })) return;
  for (const auto* inner : {"/protocol", "/minimiser", "/solids"})
    if (!root.is_sound(inner)) return;
  const auto sets = option_sets(manifest);
  check_densities(root, manifest, sets);
  check_cohesion(root, manifest, sets);
  check_particles(root, manifest, sets);
}

/// The first manifests called the stages consolidation and expansion.
void rename_stage(Json& document) {
  const Json::json_pointer stage("/start/stage");
  if (!document.contains(stage)) return;
  if (document[stage] == "consolidation") document[stage] = to_string(JamStage::compression);
  if (document[stage] == "expansion") document[stage] = to_string(JamStage::decompression);
}

/// Reads the files of /start if `with_start` is true, or if the manifest does not state their digests.
Manifest parse(std::string_view text, const std::string& file, bool with_start) {
  auto document = parse_json(text, file);
  rename_stage(document);
  Problems problems;
  const JsonPlace root(document, file, "", &problems);
  Manifest manifest;
  if (document.is_object() && document.contains("checksum")) check_own_seal(text, file);
  root.attempt([&] {
    read_into(root, manifest);
    sort_lists(manifest);
    add_defaults_of_solids(root, manifest);
    check_together(root, manifest);
  });
  problems.refuse_any(document);
  if (manifest.start && (with_start || !root.at("start").has("digests"))) load_start(root.at("start"), manifest);
  problems.refuse_any(document);
  return manifest;
}

}  // namespace

Manifest parse_manifest(std::string_view text, const std::string& file) { return parse(text, file, false); }

Manifest read_manifest(const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    const auto own = (std::filesystem::path(file) / "manifest.json").string();
    throw FileError(fmt::format("{}: is a directory; give a manifest{}", file,
                                std::filesystem::exists(own, error) ? ", for example " + own : ""),
                    FileError::Reason::no_file);
  }
  return parse(read_text(file == "-" ? "/dev/stdin" : file), file, true);
}

Json to_json(const Manifest& manifest) {
  auto json = written(manifest);
  for (const auto& [name, values] : manifest.swept) {
    const Json::json_pointer pointer(find_parameter(name)->pointer);
    json.at(pointer.parent_pointer()).erase(pointer.back());
  }
  if (manifest.free_cube_limit) json.at("protocol").erase("max_density");
  return json;
}

void sort_measures(std::vector<Measure>& measures) {
  std::sort(measures.begin(), measures.end());
  measures.erase(std::unique(measures.begin(), measures.end()), measures.end());
}

}  // namespace isojam
