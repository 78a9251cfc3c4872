#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/io/json.hpp"
#include "tasks/manifest/parameters.hpp"
#include "tasks/manifest/start.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/measure.hpp"
#include "tasks/packings/definitions.hpp"

namespace isojam {

/// Goal of a sweep point: a mean with a narrow confidence interval. A point that has reached its goal needs no more
/// replicates.
struct Goal {
  std::string quantity;   ///< name of the quantity in tables
  double half_width = 0;  ///< largest allowed half width of the 95 % confidence interval of the mean over replicates

  bool operator==(const Goal&) const = default;
};

/// Number of replicates of a sweep point.
struct Replicates {
  int min = 0, max = 0;  ///< smallest and largest number; they are equal if there is no goal
  std::optional<Goal> goal;

  bool operator==(const Replicates&) const = default;
};

inline constexpr double most_replicates = 1e6;  ///< of a sweep point

/// The measures of a manifest that does not name any.
std::vector<Measure> usual_measures();

/// The content of a manifest. All values have been checked.
struct Manifest {
  std::string name;
  std::uint64_t seed = 0;
  std::vector<Mixture> solids;  ///< in ascending order
  std::vector<int> particles;   ///< in ascending order
  /// key: the name of a swept parameter; value: options with its values, ascending and all different
  std::map<std::string, std::vector<JamOptions>, std::less<>> swept;
  Replicates replicates;
  JamOptions protocol;           ///< options of the protocol and of the minimiser
  bool free_cube_limit = false;  ///< true if the sweep has a cube for which no max_density is given
  /// key: the name of a solid in `solids`; value: the parameters of the protocol with their values for this solid only
  std::map<std::string, OptionSet, std::less<>> by_solid{};
  std::vector<Measure> measures = usual_measures();
  MeasureOptions measuring;
  /// true: paths are kept, with the packings of all states of a decompression; false: only the nearest state is kept
  bool keep_path = false;
  /// replicates with one of these flags are excluded from means, and the stopping rule ignores their values
  std::vector<Flag> exclude = usually_excluded();
  /// the base, see base.hpp; if it is empty, no rows are compared
  Json base = Json::object();
  std::optional<Start> start{};    ///< user-defined initial configurations; nullopt: random ones
  SolidDefinitions definitions{};  ///< all solids that the user defined, also those that are not swept
};

/// The fields of a manifest, in the order of its canonical form.
void describe(Fields& field, Manifest& manifest);

/// Sorts the lists whose order has no meaning.
void sort_lists(Manifest& manifest);

/// The swept parameters with their values as JSON.
using SweptValues = std::map<std::string, std::vector<Json>>;
SweptValues swept_values(const Manifest& manifest);

/// All combinations of the values of the swept parameters, each with all options of the protocol and the minimiser. If
/// no parameter is swept, there is one combination, whose `parameters` are empty.
std::vector<OptionSet> option_sets(const Manifest& manifest);

/// The options in `set`, with the values that the manifest has only for this solid. With a number of particles, the
/// options of these replicates, see densest_compression().
JamOptions options_of(const Manifest& manifest, const OptionSet& set, const Mixture& solid,
                      std::optional<int> particles = std::nullopt);

/// Parses a manifest and checks it in stages: first the JSON syntax and the checksum, then each value and combinations
/// of values without errors, and last the files of /start if it has no digests. Throws one InputError with all errors
/// of the first stage that finds an error. `file` is the name of the manifest in error messages; paths in /start are
/// relative to its folder.
Manifest parse_manifest(std::string_view text, const std::string& file);
/// Reads a manifest of the user and checks it like parse_manifest(), but always reads the files of /start. The file
/// name "-" means standard input. Throws FileError if the file cannot be read.
Manifest read_manifest(const std::string& file);

/// Canonical form of a manifest. It contains every value, including defaults, and lists whose order has no meaning are
/// sorted. User-defined solids are given by their vertices, and only if they are in the sweep. parse_manifest()
/// converts it back to the same study.
Json to_json(const Manifest& manifest);

/// Sorts measures, and removes repetitions.
void sort_measures(std::vector<Measure>& measures);

}  // namespace isojam
