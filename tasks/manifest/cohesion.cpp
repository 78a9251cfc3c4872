#include "tasks/manifest/cohesion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "engine/packing/cohesion.hpp"

namespace isojam {
namespace {

void refuse_other_solids(const JsonPlace& root, const Manifest& manifest) {
  const auto list = root.at("sweep").at("solid");
  for (const auto& mixture : manifest.solids) {
    const auto place = place_of_entry(list, Json(to_string(mixture)));
    for (const auto& kind : mixture.kinds()) {
      if (can_grow(*kind.solid)) continue;
      place.attempt([&] {
        place.refuse_with_remedy(
            fmt::format("cohesion is not possible for {}: its faces have different distances from the centroid",
                        to_string(kind.solid)),
            "remove the solid or the cohesion");
      });
    }
  }
}

/// The problem of a measure that needs repulsive forces or a jamming density; nullopt for other measures.
std::optional<std::string> problem_at_zero_pressure(Measure what) {
  if (definition_of(what).at_zero_pressure) return std::nullopt;
  return fmt::format("the measure {} is not possible at zero pressure: it needs repulsive forces or a jamming density",
                     to_string(what));
}

void refuse_measures(const JsonPlace& root, const Manifest& manifest) {
  for (const auto what : manifest.measures) {
    const auto problem = problem_at_zero_pressure(what);
    if (!problem) continue;
    const auto place = place_of_entry(root.at("measure"), Json(to_string(what)));
    place.attempt([&] {
      place.refuse_with_remedy(*problem, "remove the measure, or set /protocol/cohesion/until to \"decompression\"");
    });
  }
}

void refuse_goal(const JsonPlace& root, const Manifest& manifest) {
  if (!manifest.replicates.goal || manifest.replicates.goal->quantity != "phi_j") return;
  root.at("replicates").at("quantity").refuse_with_remedy("packings at zero pressure have no phi_j", "use \"phi_0\"");
}

}  // namespace

void check_cohesion(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets) {
  const auto any = [&](auto is_true) {
    return std::any_of(sets.begin(), sets.end(), [&](const OptionSet& set) { return is_true(set.options); });
  };
  if (!any([](const JamOptions& options) { return options.cohesion.acts(); })) return;
  refuse_other_solids(root, manifest);
  root.attempt([&] {
    if (any([](const JamOptions& options) {
          return options.cohesion.acts() && options.compression.target_before_relaxation;
        }))
      place_of(root, "target_before_relaxation")
          .refuse_with_remedy("cohesion is not possible with target_before_relaxation",
                              "set target_before_relaxation to false");
  });
  if (!any(ends_at_zero_pressure)) return;
  root.attempt([&] {
    if (any([](const JamOptions& options) { return options.cycles > 0; }))
      place_of(root, "cycles")
          .refuse_with_remedy("cycles are not possible at zero pressure, where there is no decompression",
                              "remove the cycles, or set /protocol/cohesion/until to \"decompression\"");
  });
  if (root.is_sound("/measure")) refuse_measures(root, manifest);
  if (root.is_sound("/replicates/quantity")) root.attempt([&] { refuse_goal(root, manifest); });
}

std::optional<std::string> problem_of_measures(const Manifest& manifest, const std::vector<Measure>& measures) {
  const auto sets = option_sets(manifest);
  const auto ends = [](const OptionSet& set) { return ends_at_zero_pressure(set.options); };
  if (std::none_of(sets.begin(), sets.end(), ends)) return std::nullopt;
  for (const auto what : measures) {
    if (auto problem = problem_at_zero_pressure(what)) return problem;
  }
  return std::nullopt;
}

}  // namespace isojam
