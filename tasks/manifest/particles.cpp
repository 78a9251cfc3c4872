#include "tasks/manifest/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/packing/cell/periodic_cell.hpp"

namespace isojam {
namespace {

JsonPlace place_of_particles(const JsonPlace& root, int particles) {
  return place_of_entry(root.at("sweep").at("particles"), particles);
}

/// The largest density, rounded down to four decimals, at which a cell with so many particles is large enough.
double densest(const Mixture& mixture, int particles, double grown_by) {
  const double diameter = widest_diameter(mixture, particles, grown_by);
  auto steps = std::floor(particles / cubed(2 * diameter) * 1e4);
  while (steps > 0 && side_at(particles, steps / 1e4) <= 2 * diameter) --steps;
  return steps / 1e4;
}

/// Reports an error if a kind of a mixture has no particles.
void check_kinds(const JsonPlace& root, const Manifest& manifest) {
  for (const auto& mixture : manifest.solids) {
    double rarest = 1;
    for (const auto& kind : mixture.kinds()) rarest = std::min(rarest, kind.fraction);
    for (const int particles : manifest.particles) {
      const auto counts = mixture.counts(particles);
      if (*std::min_element(counts.begin(), counts.end()) > 0) continue;
      root.attempt([&] {
        place_of_particles(root, particles)
            .refuse_with_remedy(fmt::format("{} is too small for {}: its rarest kind would have no particle", particles,
                                            to_string(mixture)),
                                fmt::format("use at least {:.0f} particles", std::ceil(1 / rarest - 1e-9)));
      });
    }
  }
}

}  // namespace

void check_particles(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets) {
  check_kinds(root, manifest);
  // The cell of a packing as given does not shrink. load_start() checks it.
  if (manifest.start && manifest.start->stage == JamStage::as_given) return;
  // The largest max_density and initial_density of a solid.
  const auto densities = [&](const Mixture& mixture) {
    std::pair<double, double> largest{0, 0};
    for (const auto& set : sets) {
      const auto options = options_of(manifest, set, mixture);
      largest.first = std::max(largest.first, options.compression.max_density);
      largest.second = std::max(largest.second, options.compression.initial_density);
    }
    return largest;
  };
  double grown_by = 0;
  for (const auto& set : sets) {
    if (set.options.cohesion.acts()) grown_by = std::max(grown_by, set.options.cohesion.range / 2);
  }
  std::vector<int> needed;
  for (const auto& mixture : manifest.solids)
    needed.push_back(least_particles(mixture, densities(mixture).first, grown_by));
  const auto most = std::max_element(needed.begin(), needed.end());
  const auto& neediest = manifest.solids[static_cast<std::size_t>(most - needed.begin())];
  const auto [density, start] = densities(neediest);  // clang 14 does not capture them under their own names
  for (const int particles : manifest.particles) {
    if (particles >= *most) continue;
    const double allowed = densest(neediest, particles, grown_by);
    root.attempt([&, largest = density, initial = start] {
      place_of_particles(root, particles)
          .refuse_with_remedy(
              fmt::format("{} is too small for {} at max_density {}{}", particles, to_string(neediest), largest,
                          grown_by > 0 ? fmt::format(" with cohesion of range {}", 2 * grown_by) : ""),
              fmt::format("use at least {} particles{}", *most,
                          allowed > std::max(initial, compressed_density)
                              ? fmt::format(" or set max_density to {} or less", allowed)
                              : ""));
    });
  }
}

}  // namespace isojam
