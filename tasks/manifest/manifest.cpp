#include "tasks/manifest/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>

#include "tasks/io/file.hpp"
#include "tasks/io/hash.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/options.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/manifest/base.hpp"
#include "tasks/manifest/by_solid.hpp"
#include "tasks/manifest/cohesion.hpp"
#include "tasks/manifest/fields.hpp"
#include "tasks/manifest/particles.hpp"
#include "tasks/manifest/shear_settings.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/packings/mixture_json.hpp"

namespace isojam {
namespace {

constexpr double greatest_seed = 9007199254740992;  // 2^53: every JSON reader represents smaller integers exactly
constexpr Range particle_range{1, 100000};
constexpr Range replicate_range{1, 1e6};
constexpr Range least_replicate_range{2, 1e6};  // at least two, because one replicate has no confidence interval
constexpr Range half_width_range{0, 1e6, true};
constexpr Range mode_range{1, 1000};
constexpr double most_replicates_in_all = 1e6;
constexpr std::size_t longest_name = 64;

constexpr std::array<std::string_view, 16> keys{"$schema",  "name",      "checksum", "seed",  "sweep", "replicates",
                                                "protocol", "minimiser", "measure",  "modes", "shear", "keep_path",
                                                "exclude",  "base",      "solids",   "start"};
constexpr std::array<std::string_view, 4> goal_keys{"min", "max", "quantity", "half_width"};

/// Name of the object to which a misplaced parameter belongs.
std::string home_of_field(std::string_view name) {
  const auto* field = find_field(name);
  return field ? pointer_of(*field) : std::string();
}

bool is_safe(std::string_view name) {
  const auto alphanumeric = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !name.empty() && name.size() <= longest_name && alphanumeric(name[0]) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return alphanumeric(c) || c == '.' || c == '_' || c == '-'; });
}

std::string read_name(const JsonPlace& place) {
  const auto allowed =
      fmt::format("1 to {} letters, digits, '.', '_' and '-', the first a letter or digit", longest_name);
  auto name = place.text(allowed);
  if (!is_safe(name)) place.refuse("the name cannot be used as the name of a directory", allowed);
  return name;
}

std::vector<Measure> default_measures() {
  std::vector<Measure> list;
  std::copy_if(all_measures.begin(), all_measures.end(), std::back_inserter(list),
               [](Measure measure) { return definition_of(measure).by_default; });
  return list;
}

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

template <class Read>
auto read_sweep_list(const JsonPlace& place, const std::string& allowed, Read read) {
  auto values = read_list(place, fmt::format("a list, each entry {}", allowed), read);
  if (place.value().empty()) place.refuse("the list is empty", fmt::format("one or more of: {}", allowed));
  std::sort(values.begin(), values.end());
  return values;
}

void read_sweep(const JsonPlace& place, Manifest& manifest) {
  std::vector<std::string_view> names{"solid", "particles"};
  for (const auto& field : all_fields()) names.push_back(field.name);
  refuse_removed(place);
  place.expect_keys(names);

  place.read("solid", [&](const JsonPlace& list) {
    manifest.solids = read_sweep_list(list, "the name of a solid or a mixture", [&](const JsonPlace& entry) {
      return read_sweep_entry(entry, manifest.definitions);
    });
    std::set<std::string_view> taken;
    for (const auto& mixture : manifest.solids) {
      if (!taken.insert(to_string(mixture)).second)
        list.refuse_with_remedy(fmt::format("two entries have the name {}", to_string(mixture)),
                                "give them different names");
    }
  });
  place.read("particles", [&](const JsonPlace& list) {
    manifest.particles = read_sweep_list(list, integer_in(particle_range), [](const JsonPlace& entry) {
      return static_cast<int>(entry.integer(particle_range));
    });
  });
  for (const auto& field : all_fields()) {
    const std::string name(field.name);
    place.read_if_any(name, [&](const JsonPlace& list) {
      auto values = read_sweep_list(list, allowed_values(field), [&](const JsonPlace& entry) {
        JamOptions options;
        read_field(entry, field, options);
        return field_value(field, options);
      });
      manifest.swept.push_back({name, std::move(values)});
    });
  }
  std::sort(manifest.swept.begin(), manifest.swept.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
}

std::string read_quantity(const JsonPlace& place) {
  std::vector<std::string_view> names;
  for (const auto& quantity : all_quantities()) names.push_back(quantity.name);
  return std::string(names[place.choice(names)]);
}

Replicates read_replicates(const JsonPlace& place) {
  Replicates replicates;
  if (!place.value().is_object()) {
    if (!place.value().is_number())
      place.not_accepted(
          fmt::format("{}, or {{\"min\", \"max\", \"quantity\", \"half_width\"}}", integer_in(replicate_range)));
    replicates.min = replicates.max = static_cast<int>(place.integer(replicate_range));
    return replicates;
  }
  place.expect_keys(goal_keys);
  auto range = least_replicate_range;
  place.read("min", [&](const JsonPlace& min) { range.low = replicates.min = static_cast<int>(min.integer(range)); });
  place.read("max", [&](const JsonPlace& max) { replicates.max = static_cast<int>(max.integer(range)); });
  auto& goal = replicates.goal.emplace();
  place.read("quantity", [&](const JsonPlace& name) { goal.quantity = read_quantity(name); });
  place.read("half_width", [&](const JsonPlace& width) { goal.half_width = width.number(half_width_range); });
  return replicates;
}

void read_group(const JsonPlace& root, const JsonPlace& place, Group group, Manifest& manifest) {
  std::vector<std::string_view> others;
  if (group == Group::protocol) others.emplace_back("by_solid");
  read_group_fields(place, group, others, home_of_field, [&](const JsonPlace& value, const Field& field) {
    const std::string name(field.name);
    if (root.has("sweep") && root.at("sweep").has(name))
      value.refuse_with_remedy("the parameter is also swept", fmt::format("set it either here or in /sweep/{}", name));
    read_field(value, field, manifest.protocol);
  });
}

std::vector<Flag> read_exclude(const JsonPlace& place) {
  auto flags = read_list(place, fmt::format("a list, each entry {}", one_of(all_names<Flag>)),
                         [](const JsonPlace& entry) { return entry.choice<Flag>(); });
  std::sort(flags.begin(), flags.end());
  return flags;
}

JsonPlace place_of_field(const JsonPlace& root, const std::string& group, const std::string& name) {
  const auto sweep = root.at("sweep");
  if (sweep.has(name)) return sweep.at(name);
  return root.has(group) && root.at(group).has(name) ? root.at(group).at(name) : root;
}

void check_count(const JsonPlace& root, const Manifest& manifest) {
  double count = static_cast<double>(manifest.solids.size() * manifest.particles.size()) * manifest.replicates.max;
  for (const auto& swept : manifest.swept) count *= static_cast<double>(swept.values.size());
  if (count > most_replicates_in_all) {
    root.at("sweep").refuse(fmt::format("the sweep has {:.0f} replicates", count),
                            fmt::format("at most {:.0f}", most_replicates_in_all));
  }
}

void check_goal(const JsonPlace& root, const Manifest& manifest) {
  if (!manifest.replicates.goal) return;
  const auto& quantity = all_quantities()[*quantity_index(manifest.replicates.goal->quantity)];
  const auto needed = quantity.measure;
  const auto& measures = manifest.measures;
  if (needed && std::find(measures.begin(), measures.end(), *needed) == measures.end()) {
    root.at("replicates")
        .at("quantity")
        .refuse_with_remedy(fmt::format("{} is not measured", quantity.name),
                            fmt::format("add \"{}\" to /measure", to_string(*needed)));
  }
}

void check_densities(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets) {
  std::vector<JamOptions> all;
  for (const auto& set : sets) {
    all.push_back(set.options);
    for (const auto& [solid, values] : manifest.by_solid) {
      for (const auto& mixture : manifest.solids) {
        if (to_string(mixture) == solid) all.push_back(options_of(manifest, set, mixture));
      }
    }
  }
  for (const auto& options : all) {
    if (options.compression.initial_density >= options.compression.max_density) {
      place_of_field(root, "protocol", "initial_density")
          .refuse_with_remedy(fmt::format("initial_density {} is not below max_density {}",
                                          options.compression.initial_density, options.compression.max_density),
                              "decrease initial_density or increase max_density");
    }
  }
}

/// Checks conditions that involve several values.
void check_together(const JsonPlace& root, const Manifest& manifest) {
  root.attempt([&] { check_goal(root, manifest); });
  root.read_if_any("base", [&](const JsonPlace& place) { check_base(place, manifest.base, manifest.swept); });
  // If there are too many combinations, do not make them.
  if (!root.attempt([&] { check_count(root, manifest); })) return;
  const auto sets = option_sets(manifest);
  root.attempt([&] { check_densities(root, manifest, sets); });
  check_cohesion(root, manifest, sets);
  check_particles(root, manifest, sets);
}

void read_values(const JsonPlace& root, Manifest& manifest) {
  root.expect_keys(keys, home_of_field);
  root.read_if_any("$schema", [](const JsonPlace& place) { place.text(); });
  root.read("name", [&](const JsonPlace& place) { manifest.name = read_name(place); });
  root.read("seed", [&](const JsonPlace& place) {
    manifest.seed = static_cast<std::uint64_t>(place.integer({0, greatest_seed}));
  });
  root.read_if_any("solids", [&](const JsonPlace& place) { manifest.definitions = read_definitions(place); });
  root.read("sweep", [&](const JsonPlace& place) { read_sweep(place, manifest); });
  for (const auto group : {Group::protocol, Group::minimiser}) {
    root.read_if_any(std::string(to_string(group)),
                     [&](const JsonPlace& place) { read_group(root, place, group, manifest); });
  }
  read_by_solid(root, manifest);
  manifest.measures = default_measures();
  root.read_if_any("measure", [&](const JsonPlace& place) {
    manifest.measures = read_list(place, fmt::format("a list, each entry {}", one_of(all_names<Measure>)),
                                  [](const JsonPlace& entry) { return entry.choice<Measure>(); });
    std::sort(manifest.measures.begin(), manifest.measures.end());
  });
  root.read("replicates", [&](const JsonPlace& place) { manifest.replicates = read_replicates(place); });
  root.read_if_any("keep_path", [&](const JsonPlace& place) { manifest.keep_path = place.boolean(); });
  root.read_if_any("exclude", [&](const JsonPlace& place) { manifest.exclude = read_exclude(place); });
  root.read_if_any("base", [&](const JsonPlace& place) { manifest.base = read_base(place); });
  root.read_if_any("start", [&](const JsonPlace& place) { manifest.start = read_start(place); });
  root.read_if_any(
      "modes", [&](const JsonPlace& place) { manifest.measuring.modes = static_cast<int>(place.integer(mode_range)); });
  root.read_if_any("shear", [&](const JsonPlace& place) { manifest.measuring.shear = read_shear(place); });
}

Json to_json(const Replicates& replicates) {
  if (!replicates.goal) return replicates.max;
  return {{"min", replicates.min},
          {"max", replicates.max},
          {"quantity", replicates.goal->quantity},
          {"half_width", replicates.goal->half_width}};
}

std::vector<Solid> all_solids_of(const Manifest& manifest) {
  std::vector<Solid> solids;
  for (const auto& mixture : manifest.solids) {
    for (const auto& kind : mixture.kinds()) solids.push_back(kind.solid);
  }
  return solids;
}

Json values_of(const std::vector<Measure>& list) {
  Json values = Json::array();
  for (const auto measure : list) values.push_back(to_string(measure));
  return values;
}

/// Reads the files of /start if `with_start` is true, or if the manifest does not state their digests.
Manifest parse(std::string_view text, const std::string& file, bool with_start) {
  const auto document = parse_json(text, file);
  Problems problems;
  const JsonPlace root(document, file, "", &problems);
  Manifest manifest;
  if (document.is_object() && document.contains("checksum")) check_own_seal(text, file);
  root.attempt([&] { read_values(root, manifest); });
  problems.refuse_any(document);
  check_together(root, manifest);
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
  Json json;
  json["name"] = manifest.name;
  json["seed"] = manifest.seed;
  auto& sweep = json["sweep"];
  for (const auto& solid : manifest.solids) sweep["solid"].push_back(sweep_entry(solid));
  sweep["particles"] = manifest.particles;
  for (const auto& swept : manifest.swept) sweep[swept.name] = swept.values;
  json["replicates"] = to_json(manifest.replicates);
  for (const auto group : {Group::protocol, Group::minimiser}) {
    auto values = group_values(group, manifest.protocol);
    for (const auto& swept : manifest.swept) {
      if (const Field& field = *find_field(swept.name); field.group == group) erase_field(values, field);
    }
    if (group == Group::protocol && !manifest.by_solid.empty()) values["by_solid"] = manifest.by_solid;
    json[std::string(to_string(group))] = std::move(values);
  }
  json["measure"] = values_of(manifest.measures);
  json["modes"] = manifest.measuring.modes;
  json["shear"] = shear_json(manifest.measuring.shear);
  json["keep_path"] = manifest.keep_path;
  json["exclude"] = option_json(manifest.exclude);
  if (!manifest.base.empty()) json["base"] = manifest.base;
  if (manifest.start) json["start"] = to_json(*manifest.start);
  if (auto definitions = definitions_json(all_solids_of(manifest)); !definitions.is_null())
    json["solids"] = definitions;
  return json;
}

Json identity(const Manifest& manifest) {
  auto json = to_json(manifest);
  json.erase("replicates");
  json.erase("keep_path");
  json.erase("exclude");
  json.erase("base");
  if (json.contains("start")) json["start"].erase("packing");  // the digests already identify the packings
  return json;
}

std::string digest(const Manifest& manifest) { return hex_hash(compact(identity(manifest))); }

Manifest with_measures(Manifest manifest, const std::vector<Measure>& more) {
  auto& all = manifest.measures;
  all.insert(all.end(), more.begin(), more.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return manifest;
}

std::string digest_without_measures(const Manifest& manifest) {
  Manifest bare = manifest;
  bare.measures.clear();
  return digest(bare);
}

bool is_of_sweep(const Manifest& manifest, const std::vector<Measure>& measures, const std::string& digest_of_record) {
  Manifest as_recorded = manifest;
  as_recorded.measures = measures;
  return digest(as_recorded) == digest_of_record;
}

}  // namespace isojam
