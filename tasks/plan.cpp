#include "tasks/plan.hpp"

#include <fmt/format.h>

#include "tasks/fields.hpp"

namespace isojam {

std::string point_text(SolidKind solid, int particles, const Json& parameters) {
  Json point;
  point["solid"] = to_string(solid);
  point["particles"] = particles;
  for (const auto& item : parameters.items()) point[item.key()] = item.value();
  return point.dump();
}

std::string point_text(const ReplicateSpec& spec) { return point_text(spec.solid, spec.particles, spec.parameters); }

std::vector<ReplicateSpec> make_plan(const Manifest& manifest) {
  const auto identity = digest(manifest);
  const auto sets = option_sets(manifest);
  std::vector<ReplicateSpec> plan;
  for (const auto solid : manifest.solids) {
    for (const int particles : manifest.particles) {
      for (const auto& set : sets) {
        for (int replicate = 0; replicate < manifest.replicates; ++replicate) {
          plan.push_back({solid, particles, set.parameters, replicate, manifest.seed, identity, set.options,
                          manifest.measures, manifest.measuring});
        }
      }
    }
  }
  return plan;
}

std::string replicate_name(const ReplicateSpec& spec) {
  const auto hash = spec.parameters.empty() ? std::string() : fmt::format("-{}", hex_hash(point_text(spec)));
  return fmt::format("{}-N{}{}-r{:04}", to_string(spec.solid), spec.particles, hash, spec.replicate);
}

RandomStream replicate_stream(const ReplicateSpec& spec, Purpose purpose) {
  return RandomStream{spec.seed, hash_of(point_text(spec)), static_cast<std::uint64_t>(spec.replicate),
                      static_cast<std::uint64_t>(purpose)};
}

Json to_json(const ReplicateSpec& spec) {
  Json json;
  json["solid"] = to_string(spec.solid);
  json["particles"] = spec.particles;
  json["parameters"] = spec.parameters;
  json["replicate"] = spec.replicate;
  for (const auto group : {Group::protocol, Group::minimiser}) {
    json[std::string(to_string(group))] = group_values(group, spec.options);
  }
  json["measure"] = Json::array();
  for (const auto measure : spec.measures) json["measure"].push_back(to_string(measure));
  json["modes"] = spec.measuring.modes;
  return json;
}

}  // namespace isojam
