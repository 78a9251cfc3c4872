#include "tasks/manifest/by_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tasks/packings/similarity.hpp"

namespace isojam {
namespace {

constexpr double neighbours_in_crystal = 26, greatest_density = 2;
constexpr double step_of_tetrahedra = 0.02;
constexpr int evaluations_of_tetrahedra = 2000;

/// The parameters that one solid may have.
Fields fields_of_solid(JamOptions& options) {
  Fields fields;
  protocol_fields(fields, options);
  std::erase_if(fields.list, [](const FieldEntry& field) { return field.key == "cohesion"; });
  fields.renamed = {{"cohesion", "/protocol/cohesion"}};
  add_former_keys(fields);
  return fields;
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

/// True if all particles are one solid with this shape, whatever its name is.
bool has_shape(const Mixture& mixture, SolidKind kind) {
  return mixture.is_one_solid() && similarity(platonic(kind), mixture.solid()->vertices()).has_value();
}

/// The names of solids of this shape in the sweep for which the manifest gives no value of the parameter.
std::vector<std::string> free_solids(const JsonPlace& root, const Manifest& manifest, SolidKind kind,
                                     const std::string& key) {
  std::vector<std::string> names;
  for (const auto& mixture : manifest.solids) {
    if (has_shape(mixture, kind) && place_of(root, key, to_string(mixture)).pointer().empty())
      names.emplace_back(to_string(mixture));
  }
  return names;
}

void read_by_solid(const JsonPlace& place, Manifest& manifest) {
  if (manifest.solids.empty()) return;  // every name would be reported as unknown
  std::vector<std::string> solids;
  for (const auto& mixture : manifest.solids) solids.emplace_back(to_string(mixture));
  refuse_solids_besides(solids, place, manifest);
  place.expect_keys(std::vector<std::string_view>(solids.begin(), solids.end()));
  for (const auto& solid : solids) {
    place.read_if_any(solid, [&](const JsonPlace& values) {
      OptionSet own;
      read_some(values, fields_of_solid(own.options), own);
      if (!own.parameters.empty()) manifest.by_solid[solid] = own;
    });
  }
}

}  // namespace

double densest_compression(const JamOptions& options) {
  const auto& compression = options.compression;
  const double overlapping = std::sqrt(2 * neighbours_in_crystal * compression.target_energy);
  const double limit = overlapping < 0.5 ? 1 / (1 - overlapping) + compression.step / 2 : greatest_density;
  return std::clamp(std::ceil(limit * 100) / 100, compression.max_density, greatest_density);
}

Custom by_solid_field(Manifest& manifest) {
  JamOptions example;
  auto values = object_schema(fields_of_solid(example));
  values["description"] = "Parameters of `protocol` for one solid.";
  const auto write = [&manifest] {
    Json json;
    for (const auto& [solid, own] : manifest.by_solid) json[solid] = own.parameters;
    return json;
  };
  return {write,
          [&manifest](const JsonPlace& place) { read_by_solid(place, manifest); },
          {{"type", "object"}, {"additionalProperties", std::move(values)}},
          "object of solids and their parameters"};
}

void add_defaults_of_solids(const JsonPlace& root, Manifest& manifest) {
  manifest.free_cube_limit = !free_solids(root, manifest, SolidKind::cube, "max_density").empty();
  // φ_J of tetrahedra depends on their compression (examples/02-strain-step).
  const auto give = [&](const std::string& key, auto Compression::*member, auto value) {
    for (const auto& name : free_solids(root, manifest, SolidKind::tetrahedron, key)) {
      auto& own = manifest.by_solid[name];
      own.parameters[key] = own.options.compression.*member = value;
    }
  };
  give("compression_step", &Compression::step, step_of_tetrahedra);
  give("compression_evaluations", &Compression::evaluations, evaluations_of_tetrahedra);
}

std::vector<OptionSet> option_sets(const Manifest& manifest) {
  std::vector<OptionSet> sets{{Json::object(), manifest.protocol}};
  for (const auto& [name, values] : manifest.swept) {
    std::vector<OptionSet> longer;
    for (const auto& set : sets) {
      for (const auto& options : values) {
        longer.push_back(set);
        longer.back().parameters[name] = value_of(name, options);
        copy_values({{{name, nullptr}}, options}, longer.back().options);
      }
    }
    sets = std::move(longer);
  }
  return sets;
}

JamOptions options_of(const Manifest& manifest, const OptionSet& set, const Mixture& solid,
                      std::optional<int> particles) {
  auto options = set.options;
  bool is_free = particles && manifest.free_cube_limit;
  if (const auto own = manifest.by_solid.find(to_string(solid)); own != manifest.by_solid.end()) {
    copy_values(own->second, options);
    is_free = is_free && !own->second.parameters.contains("max_density");
  }
  if (is_free && has_shape(solid, SolidKind::cube)) {
    auto& limit = options.compression.max_density;
    const double usual = limit;
    // In a smaller cell, a particle could touch two images of another one.
    for (limit = densest_compression(options); limit > usual && *particles < least_particles(solid, limit);)
      limit = std::max(usual, std::round(100 * limit - 1) / 100);
  }
  return options;
}

}  // namespace isojam
