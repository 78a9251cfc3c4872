#include "tasks/manifest/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>
#include <utility>

#include "engine/analysis/orientation_order.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "tasks/manifest/particles.hpp"

namespace isojam {
namespace {

/// Known properties of the packings of a solid. `density` is the density near which they jam (Table I of the paper; for
/// cubes, sixteen compressions with N = 100). `stiffness` is the largest value of (E/N)/Δφ⁶ for Δφ from 0.004 to 0.05
/// and N = 64 to 100.
struct Known {
  SolidKind kind;
  double density, stiffness;
};
constexpr std::array known{
    Known{SolidKind::tetrahedron, 0.63, 0.8}, Known{SolidKind::cube, 0.75, 10},
    Known{SolidKind::octahedron, 0.68, 4},    Known{SolidKind::dodecahedron, 0.705, 25},
    Known{SolidKind::icosahedron, 0.695, 30},
};
/// Three standard deviations of φ_J between packings with N = 100. The φ_J of cubes varies more; for cubes this is less
/// than one standard deviation.
constexpr double scatter = 0.03;

/// Relative change of a volume that a user should know.
constexpr double noticeable_change = 1e-5;

/// Smallest height of a free cell, divided by the side of a cube of the same volume. The least of 8 packings of 64
/// octahedra was 0.88, those of 100 and 200 tetrahedra 0.86 and 0.89; cubes, which form layers, reached 0.70.
constexpr double least_height = 0.85, least_height_of_cubes = 0.7;

/// At Δφ = 0.008, methods other than Newton's and the multipliers still have residuals of 3e-4 and more after so many
/// evaluations. At Δφ = 0.03, most reach 1e-6.
constexpr long insufficient_evaluations = 60000;
constexpr double near_jamming = 0.01, residual_left = 3e-4;

/// Tetrahedra that are relaxed with fewer evaluations during compression jam at lower densities: see
/// examples/02-strain-step.
constexpr int relaxed_evaluations = 500;

class Warnings {
 public:
  explicit Warnings(const Manifest& manifest) : manifest_(manifest) {}

  /// Adds a warning, unless there is already one for this key. Warnings that depend on the solid are added once per
  /// solid.
  void add(std::string_view name, const std::string& solid, const std::string& text) {
    if (!warned_.emplace(name, solid).second) return;
    const auto pointer =
        manifest_.swept.contains(name) ? fmt::format("/sweep/{}", name) : find_parameter(name)->pointer;
    lines_.push_back(fmt::format("{}: {}", pointer, text));
  }

  /// Adds a warning about a value that is not a parameter.
  void add_at(std::string_view pointer, const std::string& text) {
    if (!text.empty()) lines_.push_back(fmt::format("{}: {}", pointer, text));
  }

  std::vector<std::string> take() { return std::move(lines_); }

 private:
  const Manifest& manifest_;
  std::set<std::pair<std::string, std::string>> warned_;
  std::vector<std::string> lines_;
};

/// Warns if there will be no states to which φ_J can be fitted.
void look_at_window(const JamOptions& options, Warnings& warnings) {
  // The decompression ends with a state within final_distance. The state before it can be one step farther away.
  const double last = options.decompression.final_distance;
  const double before =
      std::min(last / (1 - options.decompression.step_fraction), last + options.decompression.longest_step);
  if (last >= options.decompression.fit_window) {
    warnings.add("final_distance", "",
                 fmt::format("{} is not below fit_window {}: at most one state would be in the window, and phi_j would "
                             "be fitted to states outside it; increase fit_window",
                             last, options.decompression.fit_window));
  } else if (before >= options.decompression.fit_window) {
    warnings.add(
        "fit_window", "",
        fmt::format("{} may contain only one state, but phi_j is fitted to two or more: with step_fraction {} the "
                    "last two states are up to {:.3g} and {} above jamming; increase fit_window",
                    options.decompression.fit_window, options.decompression.step_fraction, before, last));
  }
}

void look_at_minimiser(const JamOptions& options, const std::vector<Flag>& exclude, Warnings& warnings) {
  const auto& minimise = options.minimise;
  if (minimise.energy_change > 0 && std::find(exclude.begin(), exclude.end(), Flag::not_balanced) != exclude.end()) {
    warnings.add(
        "energy_change", "",
        fmt::format("{} accepts states that are not balanced, and /exclude removes such replicates from all means; few "
                    "or none may remain",
                    minimise.energy_change));
  }
  const bool second_order = minimise.method == Method::newton || minimise.method == Method::multipliers;
  if (!second_order && minimise.energy_change == 0 && minimise.residual < residual_left &&
      minimise.max_evaluations <= insufficient_evaluations && options.decompression.final_distance < near_jamming) {
    warnings.add("method", "",
                 fmt::format("{} does not reach residual {} in {} evaluations at final_distance {}; use multipliers",
                             to_string(minimise.method), minimise.residual, minimise.max_evaluations,
                             options.decompression.final_distance));
  }
}

/// Warns if the protocol cannot reach the density at which packings of this solid jam, or at which they have the target
/// energy.
void look_at_density(const JamOptions& options, const Known& solid, Warnings& warnings) {
  const std::string name(to_string(solid.kind));
  // If the target applies to the energy before relaxation, the compression ends just above jamming.
  const double distance = options.compression.target_before_relaxation
                              ? 0
                              : nearest::pow(options.compression.target_energy / solid.stiffness, 1.0 / 6);
  const double needed = solid.density + distance;
  const auto where = distance == 0 ? fmt::format("{} packings jam at about {:.3g}", name, solid.density)
                                   : fmt::format(
                                         "{} packings jam at about {:.3g} and reach target_energy {} at about "
                                         "{:.2f}",
                                         name, solid.density, options.compression.target_energy, needed);
  // Packings reach the target energy at different densities, so the mean density plus a margin is needed. If the
  // compression ends just above jamming (distance 0), no margin is needed.
  if (options.compression.max_density < needed + (distance == 0 ? 0 : scatter))
    warnings.add("max_density", name,
                 fmt::format("{} is too low{}: {}; increase max_density", options.compression.max_density,
                             options.compression.max_density < needed ? "" : " for some packings", where));
  const double reached = options.compression.initial_density + (options.max_steps - 1) * options.compression.step;
  if (reached < needed - scatter) {
    warnings.add(
        "max_steps", name,
        fmt::format(
            "{} steps of {} from density {}, the first without strain, reach at most {:.2f}: {}; increase max_steps",
            options.max_steps, options.compression.step, options.compression.initial_density, reached, where));
  }
  if (distance > 0 && distance <= options.decompression.final_distance) {
    warnings.add(
        "target_energy", name,
        fmt::format("at {} {} packings are only about {:.2g} above jamming: the decompression to final_distance {} "
                    "would have no step; increase target_energy",
                    options.compression.target_energy, name, distance, options.decompression.final_distance));
  }
}

void look_at_solid(const JamOptions& options, const Known& solid, Warnings& warnings) {
  const std::string name(to_string(solid.kind));
  look_at_density(options, solid, warnings);
  if (solid.kind == SolidKind::tetrahedron && options.compression.evaluations < relaxed_evaluations) {
    warnings.add("compression_evaluations", name,
                 fmt::format("{} evaluations are too few for tetrahedra, which then jam at lower densities; use at "
                             "least {}",
                             options.compression.evaluations, relaxed_evaluations));
  }
}

/// Warns if most particles of an initial packing have the same orientation. Its orientational order is then far above
/// that of jammed packings, which is at most 0.71 if they are partly crystalline.
void look_at_start(const StartFile& file, Warnings& warnings) {
  constexpr double ordered = 0.75;
  for (const auto& note : file.notes) warnings.add_at("/start/packing", fmt::format("{}: {}", file.path, note));
  if (!file.packing) return;
  // In a jammed packing at the target energy, the deepest overlap is about 0.02.
  constexpr double deep = 0.03, shallower = 0.7;
  const auto overlap =
      fmt::format("{}: the deepest overlap is {:.2g} of the volume of a particle", file.path, file.deepest_overlap);
  if (file.deepest_overlap > deep && file.deepest_reordered.value_or(1) < shallower * file.deepest_overlap)
    warnings.add_at("/start/packing",
                    fmt::format("{}, but {:.2g} if the quaternions have the order w x y z; if they have, write them in "
                                "the order x y z w",
                                overlap, *file.deepest_reordered));
  else if (file.deepest_overlap > deep)
    warnings.add_at("/start/packing", overlap + "; check the unit of length, the cell and the orientations");
  const auto order = order_of(*file.packing, {});
  if (!order.S || *order.S <= std::max(ordered, 2 * order.random_S)) return;
  warnings.add_at("/start/packing",
                  fmt::format("{}: the packing is ordered: its orientational order S is {:.2f} instead of {:.2f} for "
                              "independent orientations; use a disordered packing, or treat the results as those of a "
                              "crystal",
                              file.path, *order.S, order.random_S));
}

/// The number of replicates that the stopping rule requests grows with the square of Student's t for `min` values,
/// which is 2.4 for 8 values, 3.2 for 4 values and 12.7 for 2 values.
constexpr int reliable_min = 8;

void look_at_goal(const Replicates& replicates, Warnings& warnings) {
  if (!replicates.goal || replicates.min == replicates.max || replicates.min >= reliable_min) return;
  warnings.add_at("/replicates/min",
                  fmt::format("the stopping rule uses the standard deviation of the first {} replicates, which is "
                              "uncertain, so it may request many more replicates than necessary; use at least {}",
                              replicates.min, reliable_min));
}

bool requests(const Manifest& manifest, std::initializer_list<Measure> any) {
  const auto& measures = manifest.measures;
  return std::find_first_of(measures.begin(), measures.end(), any.begin(), any.end()) != measures.end();
}

/// Warns of keys whose values nothing uses.
void look_at_effects(const Manifest& manifest, Warnings& warnings) {
  const MeasureOptions usual;
  if (written(manifest.measuring.shear) != written(usual.shear) && !requests(manifest, {Measure::shear}))
    warnings.add_at("/shear", "has no effect without the measure; add \"shear\" to /measure");
  if (manifest.measuring.exponents_of_all_states && !requests(manifest, {Measure::exponents}))
    warnings.add_at("/exponents_of_all_states", "has no effect without the measure; add \"exponents\" to /measure");
  if (manifest.measuring.modes != usual.modes &&
      !requests(manifest, {Measure::modes, Measure::backbone, Measure::prestress}))
    warnings.add_at("/modes", "has no effect without a measure of modes; add \"modes\" to /measure");
  for (const auto flag : manifest.exclude) {
    const auto usually = usually_excluded();
    if (std::find(usually.begin(), usually.end(), flag) != usually.end()) continue;
    const auto sets = [&](Measure what) {
      const auto& flags = definition_of(what).flags;
      return std::find(flags.begin(), flags.end(), flag) != flags.end();
    };
    if (std::none_of(all_measures.begin(), all_measures.end(), sets) ||
        std::any_of(manifest.measures.begin(), manifest.measures.end(), sets))
      continue;
    const auto what = *std::find_if(all_measures.begin(), all_measures.end(), sets);
    warnings.add_at("/exclude", fmt::format("\"{}\" has no effect, because no measure of this manifest sets this flag; "
                                            "add \"{}\" to /measure",
                                            to_string(flag), to_string(what)));
  }
  for (const auto& [name, definition] : manifest.definitions) {
    const auto is_it = [&solid = name](const auto& kind) { return to_string(kind.solid) == solid; };
    const auto uses = [&](const Mixture& mixture) {
      return std::any_of(mixture.kinds().begin(), mixture.kinds().end(), is_it);
    };
    if (std::none_of(manifest.solids.begin(), manifest.solids.end(), uses))
      warnings.add_at("/solids/" + name, "has no effect; add the name to /sweep/solid");
  }
}

/// Warns of settings of cohesion that have no effect.
void look_at_cohesion(const Manifest& manifest, const std::vector<OptionSet>& sets, Warnings& warnings) {
  const auto acts = [](const OptionSet& set) { return set.options.cohesion.acts(); };
  if (std::none_of(sets.begin(), sets.end(), acts)) {
    for (const auto& [name, pointer, field, absent] : all_parameters()) {
      if (name.starts_with("cohesion.") && value_of(name, sets.front().options) != written(field))
        warnings.add(name, "", "has no effect, because the strength of the cohesion is 0");
    }
  } else if (manifest.start && manifest.start->stage == JamStage::decompression) {
    const auto ends = [](const OptionSet& set) { return ends_at_zero_pressure(set.options); };
    if (std::none_of(sets.begin(), sets.end(), ends))
      warnings.add(
          "cohesion.until", "",
          "cohesion has no effect, because it acts only during compression, and /start/stage is decompression");
  }
}

/// Warns of a free cell that can become so flat that a particle touches two images of another one.
void look_at_free_cell(const JamOptions& options, const Mixture& mixture, int particles, Warnings& warnings) {
  if (options.cell != CellShape::free) return;
  const double height = mixture == Mixture(SolidKind::cube) ? least_height_of_cubes : least_height;
  const double grown_by = options.cohesion.acts() ? options.cohesion.range / 2 : 0;
  const double density = std::min(options.compression.max_density, compressed_density);
  const int enough = least_particles(mixture, density / cubed(height), grown_by);
  if (particles >= enough) return;
  warnings.add(
      "cell", std::string(to_string(mixture)),
      fmt::format("a free cell with {} particles of {} can become too flat, and the replicate then fails; use at "
                  "least {} particles",
                  particles, to_string(mixture), enough));
}

/// Warns of parameters that a later stage or another parameter makes ineffective.
void look_at_unused(const Manifest& manifest, const JamOptions& options, Warnings& warnings) {
  if (!manifest.start) return;
  for (const auto& [name, pointer, field, absent] : all_parameters()) {
    const bool is_initial = name == "initial_density";
    const bool of_compression = name.starts_with("compression_") || name.starts_with("target_");
    if (!is_initial && !(of_compression && manifest.start->stage == JamStage::decompression)) continue;
    if (value_of(name, options) == written(field)) continue;
    warnings.add(name, "",
                 is_initial ? "has no effect, because /start gives the initial packings; set /start/density"
                            : "has no effect, because /start/stage is decompression: there is no compression");
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Manifest& manifest) {
  Warnings warnings(manifest);
  look_at_goal(manifest.replicates, warnings);
  look_at_effects(manifest, warnings);
  const auto sets = option_sets(manifest);
  look_at_cohesion(manifest, sets, warnings);
  for (const auto& set : sets) {
    look_at_minimiser(set.options, manifest.exclude, warnings);
    for (const auto& mixture : manifest.solids) {
      const auto options = options_of(manifest, set, mixture);
      look_at_window(options, warnings);
      look_at_unused(manifest, options, warnings);
      look_at_free_cell(options, mixture, std::ranges::min(manifest.particles), warnings);
      for (const auto& solid : known) {
        if (mixture == Mixture(solid.kind)) look_at_solid(options, solid, warnings);
      }
    }
  }
  for (const auto& [name, definition] : manifest.definitions) {
    warnings.add_at("/solids/" + name, precision_warning(definition.solid));
    if (std::abs(definition.report.volume_change) > noticeable_change)
      warnings.add_at("/solids/" + name,
                      fmt::format("the repairs changed the volume by {:.2g} %", 100 * definition.report.volume_change));
  }
  if (manifest.start) {
    for (const auto& file : manifest.start->files) look_at_start(file, warnings);
  }
  return warnings.take();
}

}  // namespace isojam
