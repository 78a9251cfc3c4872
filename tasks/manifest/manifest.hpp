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

/// An interval narrow enough to stop at.
struct Goal {
  std::string quantity;   ///< name of a column of the tables
  double half_width = 0;  ///< of the 95 % interval of its mean over replicates

  bool operator==(const Goal&) const = default;
};

/// How many replicates a sweep point gets.
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
  std::vector<Flag> exclude = usually_excluded();  ///< replicates so flagged count in no mean and towards no goal
  /// Swept parameters and their values: the row that others are compared with; see base.hpp. Empty: none.
  Json base = Json::object();
  std::optional<Start> start{};  ///< packings of one's own instead of random ones
};

/// One combination of the swept parameters: the whole options, and what distinguishes them from other combinations.
struct OptionSet {
  Json parameters;  ///< object: swept names, in order, and their values
  JamOptions options;
};

/// All combinations; one with an empty object if nothing but solids and particles is swept.
std::vector<OptionSet> option_sets(const Manifest& manifest);

/// Reads a manifest strictly: throws InputError for anything not understood, all of it at once, and for particles too
/// few for their cell.
Manifest parse_manifest(std::string_view text, const std::string& file);
/// "-" is standard input. Throws FileError if the file cannot be read.
Manifest read_manifest(const std::string& file);

/// Canonical form: every value spelt out, lists in order. parse_manifest(to_json(m)) gives m.
Json to_json(const Manifest& manifest);

/// The canonical form of everything that a replicate's result depends on; the number of replicates is left out, so that
/// it may be raised later, and what is kept beside the record, excluded from means, or compared.
Json identity(const Manifest& manifest);
std::string digest(const Manifest& manifest);

/// The same sweep with these measures as well, in the order of records.
Manifest with_measures(Manifest manifest, const std::vector<Measure>& more);
/// The digest of the sweep, whatever is measured.
std::string digest_without_measures(const Manifest& manifest);
/// Whether two manifests differ in nothing but what is measured, if in that.
bool is_same_sweep(const Manifest& a, const Manifest& b);
/// Whether `digest_of_record` is that of this sweep, measured so.
bool is_of_sweep(const Manifest& manifest, const std::vector<Measure>& measures, const std::string& digest_of_record);

/// By which keys two manifests of different digest differ, with both values: "/seed: 8 there, 7 here; ...", a handful
/// and how many more. Empty if their digests are the same.
std::string differences(const Manifest& theirs, const Manifest& ours);

}  // namespace isojam
