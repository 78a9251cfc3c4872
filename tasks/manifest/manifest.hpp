#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/packing/mixture/mixture.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/io/json.hpp"
#include "tasks/manifest/start.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/measure.hpp"

namespace isojam {

/// A parameter of the protocol or the minimiser that takes several values.
struct SweptField {
  std::string name;          ///< name, as in find_field()
  std::vector<Json> values;  ///< values in canonical form, ascending, all different
};

/// Goal of a stopping rule: a sweep point needs no more replicates if a confidence interval is narrow enough.
struct Goal {
  std::string quantity;   ///< name of a column of the tables
  double half_width = 0;  ///< largest half width of the 95 % confidence interval of the mean over replicates

  bool operator==(const Goal&) const = default;
};

/// Number of replicates of a sweep point.
struct Replicates {
  int min = 0, max = 0;  ///< smallest and largest number; both are equal if there is no goal
  std::optional<Goal> goal;

  bool operator==(const Replicates&) const = default;
};

/// A study as the user requested it. All values have been checked.
struct Manifest {
  std::string name;
  std::uint64_t seed = 0;
  std::vector<Mixture> solids;    ///< in ascending order
  std::vector<int> particles;     ///< in ascending order
  std::vector<SweptField> swept;  ///< swept parameters, sorted by name
  Replicates replicates;
  JamOptions protocol;  ///< options of the protocol and of the minimiser
  std::vector<Measure> measures;
  MeasureOptions measuring;
  /// keep the packings of all states of a decompression, not only of the state nearest jamming
  bool keep_path = false;
  /// replicates with one of these flags are left out of means, and the stopping rule ignores them
  std::vector<Flag> exclude = usually_excluded();
  /// Swept parameters and their values that select the base row, see base.hpp. Empty: rows are not compared.
  Json base = Json::object();
  std::optional<Start> start{};  ///< user-defined initial packings instead of random ones
};

/// One combination of the values of swept parameters: the complete options, and the values of the swept parameters.
struct OptionSet {
  Json parameters;  ///< JSON object with the names of the swept parameters, in order, and their values
  JamOptions options;
};

/// All combinations of the values of swept parameters. If only solids and particles are swept, there is one combination
/// with an empty object.
std::vector<OptionSet> option_sets(const Manifest& manifest);

/// Parses a manifest. Throws one InputError with all errors: unknown keys, values that are not allowed, and too few
/// particles for the cell.
Manifest parse_manifest(std::string_view text, const std::string& file);
/// Reads and parses a manifest. The file name "-" means standard input. Throws FileError if the file cannot be read.
Manifest read_manifest(const std::string& file);

/// Canonical form of a manifest: it contains every value, also defaults, and lists are sorted. parse_manifest() of this
/// form gives the same manifest.
Json to_json(const Manifest& manifest);

/// Canonical form of everything on which the result of a replicate depends. It does not contain the keys that may
/// change later: the number of replicates, the files to keep, the excluded flags and the base.
Json identity(const Manifest& manifest);
std::string digest(const Manifest& manifest);

/// The manifest with more measures, sorted as in records.
Manifest with_measures(Manifest manifest, const std::vector<Measure>& more);
/// The digest of the manifest without its measures.
std::string digest_without_measures(const Manifest& manifest);
/// True if two manifests differ at most in their measures.
bool is_same_sweep(const Manifest& a, const Manifest& b);
/// True if `digest_of_record` is the digest of this manifest with these measures instead of its own.
bool is_of_sweep(const Manifest& manifest, const std::vector<Measure>& measures, const std::string& digest_of_record);

/// Text with the keys in which two manifests differ, and both values: "/seed: 8 there, 7 here; ...". It lists a few
/// keys and states the number of the others. Empty if the digests are equal.
std::string differences(const Manifest& theirs, const Manifest& ours);

}  // namespace isojam
