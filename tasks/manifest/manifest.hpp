#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/json/json.hpp"
#include "tasks/manifest/start.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/measure.hpp"

namespace isojam {

/// A parameter of the protocol or the minimiser that takes several values.
struct SweptField {
  std::string name;          ///< as find_field knows it
  std::vector<Json> values;  ///< canonical, ascending, no two equal
};

/// Half width of a confidence interval at which a sweep point stops.
struct Goal {
  std::string quantity;   ///< name of a column of the tables
  double half_width = 0;  ///< of the 95 % confidence interval of the mean over replicates

  bool operator==(const Goal&) const = default;
};

/// Number of replicates of a sweep point.
struct Replicates {
  int min = 0, max = 0;  ///< equal without a goal
  std::optional<Goal> goal;

  bool operator==(const Replicates&) const = default;
};

/// A sweep as the user asked for it, every value checked.
struct Manifest {
  std::string name;
  std::uint64_t seed = 0;
  std::vector<Mixture> solids;    ///< ascending
  std::vector<int> particles;     ///< ascending
  std::vector<SweptField> swept;  ///< by name
  Replicates replicates;
  JamOptions protocol;  ///< with the minimiser's options
  std::vector<Measure> measures;
  MeasureOptions measuring;
  bool keep_path = false;  ///< keep the packings of every state of an expansion, not only the one nearest jamming
  std::vector<Flag> exclude = usually_excluded();  ///< replicates with one of these flags count in no mean and towards
                                                   ///< no goal
  /// Swept parameters and their values that identify the row to compare with; see base.hpp. Empty: none.
  Json base = Json::object();
  std::optional<Start> start{};  ///< user-defined initial packings instead of random ones
};

/// One combination of the swept parameters: the complete options, and the parameters that distinguish them from other
/// combinations.
struct OptionSet {
  Json parameters;  ///< object: swept names, in order, and their values
  JamOptions options;
};

/// All combinations; one with an empty object if only solids and particles are swept.
std::vector<OptionSet> option_sets(const Manifest& manifest);

/// Reads a manifest strictly. Throws InputError with all errors at once: everything that is not understood, and too few
/// particles for the cell.
Manifest parse_manifest(std::string_view text, const std::string& file);
/// "-" is standard input. Throws FileError if the file cannot be read.
Manifest read_manifest(const std::string& file);

/// Canonical form: every value spelt out, lists in order. parse_manifest(to_json(m)) gives m.
Json to_json(const Manifest& manifest);

/// The canonical form of everything that a replicate's result depends on. It omits the number of replicates, so that it
/// can be raised later, and which files are kept, which replicates are excluded and which rows are compared.
Json identity(const Manifest& manifest);
std::string digest(const Manifest& manifest);

/// The same sweep with these measures added, in the order of records.
Manifest with_measures(Manifest manifest, const std::vector<Measure>& more);
/// The digest of the sweep, independent of its measures.
std::string digest_without_measures(const Manifest& manifest);
/// True if two manifests differ at most in their measures.
bool is_same_sweep(const Manifest& a, const Manifest& b);
/// True if `digest_of_record` is the digest of this sweep with these measures.
bool is_of_sweep(const Manifest& manifest, const std::vector<Measure>& measures, const std::string& digest_of_record);

/// Lists the keys in which two manifests of different digest differ, with both values: "/seed: 8 there, 7 here; ...". A
/// few are listed and the others counted. Empty if the digests are equal.
std::string differences(const Manifest& theirs, const Manifest& ours);

}  // namespace isojam
