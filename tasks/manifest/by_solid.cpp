#include "tasks/manifest/by_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tasks/manifest/fields.hpp"

namespace isojam {
namespace {

constexpr double neighbours_in_crystal = 26, greatest_density = 2;
constexpr int evaluations_of_tetrahedra = 2000;

/// Reads the parameters of one solid.
Json read_values(const JsonPlace& root, const JsonPlace& place) {
  Json values = Json::object();
  JamOptions options;
  read_group_fields(place, Group::protocol, {}, nullptr, [&](const JsonPlace& value, const Field& field) {
    const std::string name(field.name);
    if (is_nested(field))
      value.refuse_with_remedy("the parameter must be the same for all solids",
                               fmt::format("set it in {}", pointer_of(field)));
    if (root.at("sweep").has(name))
      value.refuse_with_remedy("the parameter is also swept", fmt::format("set it either here or in /sweep/{}", name));
    read_field(value, field, options);
    values[name] = field_value(field, options);
  });
  return values;
}

/// Reports solids that are not in the sweep.
void refuse_solids_besides(const std::vector<std::string>& swept, const JsonPlace& place, const Manifest& manifest) {
  if (!place.value().is_object()) return;
  for (const auto& item : place.value().items()) {
    const auto& name = item.key();
    const bool is_solid = Solid::named(name) || manifest.definitions.contains(name);
    if (!is_solid || std::find(swept.begin(), swept.end(), name) != swept.end()) continue;
    place.read(name, [&](const JsonPlace& values) {
      values.refuse_with_remedy(fmt::format("{} is not in /sweep/solid", name), "add it there, or remove this entry");
    });
  }
}

/// True if the sweep has this solid and the manifest gives no value of the parameter for it.
bool is_free(const JsonPlace& root, const Manifest& manifest, SolidKind kind, const std::string& key) {
  const bool is_swept =
      std::find(manifest.solids.begin(), manifest.solids.end(), Mixture(kind)) != manifest.solids.end();
  if (!is_swept || root.at("sweep").has(key) || (root.has("protocol") && root.at("protocol").has(key))) return false;
  const auto own = manifest.by_solid.find(to_string(kind));
  return own == manifest.by_solid.end() || !own->second.contains(key);
}

/// Cubes order during compression. A crystal can exceed the usual limit long before it has the target energy.
void put_limit_of_cubes(const JsonPlace& root, Manifest& manifest) {
  const Mixture cube = SolidKind::cube;
  if (!is_free(root, manifest, SolidKind::cube, "max_density")) return;
  auto options = options_of(manifest, {Json::object(), manifest.protocol}, cube);
  for (const auto& swept : manifest.swept) {
    if (swept.name == "target_energy" || swept.name == "consolidation_step")
      read_field({swept.values.back(), manifest.name}, *find_field(swept.name), options);
  }
  const double limit = densest_compression(options);
  // In a smaller cell, a particle could touch two images of another one at this density.
  const bool fits = std::all_of(manifest.particles.begin(), manifest.particles.end(),
                                [&](int particles) { return particles >= least_particles(cube, limit); });
  if (fits) manifest.by_solid[std::string(to_string(cube))]["max_density"] = limit;
}

/// φ_J of tetrahedra depends on how completely the states of the compression are relaxed (examples/02-strain-step).
void put_relaxation_of_tetrahedra(const JsonPlace& root, Manifest& manifest) {
  const std::string key = "consolidation_evaluations";
  if (!is_free(root, manifest, SolidKind::tetrahedron, key)) return;
  manifest.by_solid[std::string(to_string(SolidKind::tetrahedron))][key] = evaluations_of_tetrahedra;
}

}  // namespace

double densest_compression(const JamOptions& options) {
  const auto& compression = options.compression;
  const double overlapping = std::sqrt(2 * neighbours_in_crystal * compression.target_energy);
  const double limit = overlapping < 0.5 ? 1 / (1 - overlapping) + compression.step : greatest_density;
  return std::clamp(std::ceil(limit * 100) / 100, compression.max_density, greatest_density);
}

void read_by_solid(const JsonPlace& root, Manifest& manifest) {
  // Without a valid sweep, every name would be reported as unknown.
  if (manifest.solids.empty() || !root.at("sweep").value().is_object()) return;
  if (root.has("protocol") && root.at("protocol").value().is_object()) {
    root.at("protocol").read_if_any("by_solid", [&](const JsonPlace& place) {
      std::vector<std::string> solids;
      for (const auto& mixture : manifest.solids) solids.emplace_back(to_string(mixture));
      refuse_solids_besides(solids, place, manifest);
      place.expect_keys(std::vector<std::string_view>(solids.begin(), solids.end()));
      for (const auto& solid : solids) {
        place.read_if_any(solid, [&](const JsonPlace& values) {
          auto own = read_values(root, values);
          if (!own.empty()) manifest.by_solid[solid] = std::move(own);
        });
      }
    });
  }
  put_limit_of_cubes(root, manifest);
  put_relaxation_of_tetrahedra(root, manifest);
}

std::vector<OptionSet> option_sets(const Manifest& manifest) {
  std::vector<OptionSet> sets{{Json::object(), manifest.protocol}};
  for (const auto& swept : manifest.swept) {
    std::vector<OptionSet> longer;
    for (const auto& set : sets) {
      for (const auto& value : swept.values) {
        longer.push_back(set);
        longer.back().parameters[swept.name] = value;
        read_field({value, manifest.name}, *find_field(swept.name), longer.back().options);
      }
    }
    sets = std::move(longer);
  }
  return sets;
}

JamOptions options_of(const Manifest& manifest, const OptionSet& set, const Mixture& solid) {
  auto options = set.options;
  const auto own = manifest.by_solid.find(to_string(solid));
  if (own == manifest.by_solid.end()) return options;
  for (const auto& item : own->second.items())
    read_field({item.value(), manifest.name}, *find_field(item.key()), options);
  return options;
}

}  // namespace isojam
