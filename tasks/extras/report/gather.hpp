#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "tasks/extras/report/angle_curves.hpp"
#include "tasks/extras/report/distributions.hpp"
#include "tasks/extras/report/view.hpp"
#include "tasks/records/recorded.hpp"
#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// Makes the data of a report from records, which it reads one by one. Of each it keeps only what the report shows.
class ReportData {
 public:
  /// `manifest` is in canonical form, or null.
  explicit ReportData(Json manifest);

  /// Adds a replicate, which the report shows with this name.
  void add(const RecordedReplicate& replicate, const std::string& name);
  /// All replicates, for choose_views().
  std::span<const Viewable> viewable() const { return viewable_; }

  /// The text of a JSON object. `views` are texts of packings, see packing_view(), each with the name of its replicate.
  /// May be called once. The keys are those of `more`, and:
  /// - manifest: {"name", "seed"} as texts; null if unknown
  /// - exclude: flags that exclude a replicate from means
  /// - builds: provenance of the records; each one occurs once
  /// - measures: measures that at least one record has
  /// - addable: all other measures, which "isojam measure" can add
  /// - keeps_paths: false if the manifest does not keep paths; "isojam measure" then adds measures only for the nearest
  ///   states
  /// - columns: {"name", "group", "unit", "latex"} of all quantities, in the order of tables
  /// - parameters: names of the swept parameters, and for each the heading of its column
  /// - rows: the rows of tables.json. Each also has "label", "paper" (φ_J of Table I, or null), "scaling" (power laws
  ///   of ⟨ω⟩), "angles" (distributions of alignment angles) and "distributions" (see Distributions). Failed and
  ///   excluded replicates do not contribute to the last three.
  /// - base: title of the table of paired differences; empty if there is no base
  /// - csv, latex: the table as CSV and as LaTeX
  /// - views: the elements of `views`
  /// - replicates: one object for each replicate, with "name", "row", "status", "flags", "excluded", "failure",
  ///   "states", "line" (the line that was extrapolated to φ_J) and other values
  /// - solids: shapes and angle_references() of all solids and mixtures
  std::string text(const std::vector<std::string>& views, const Json& more);

 private:
  /// States near jamming, to which ⟨ω⟩ ∝ Δφ^x is fitted.
  struct Scaling {
    std::vector<double> distances, values;
    void add(const Json& states, const char* key);
    Json json() const;  ///< null if there are too few states
  };
  /// Alignment angles of the contacts, and cut-offs of the replicates.
  struct Angles {
    ThinnedCdf cdf;
    std::vector<double> cutoffs;
    int replicates = 0;
    void add(const Json& nearest, const std::string& kind);
    Json json() const;
  };
  /// What a row needs of the replicates that neither failed nor are excluded.
  struct Pool {
    std::vector<std::pair<const char*, Scaling>> scaling{{"omega_l", {}}, {"omega_h", {}}};
    std::vector<std::pair<std::string, Angles>> angles{{"face_face", {}}, {"edge_face", {}}};
    Distributions distributions;
  };
  Json row_entry(const Row& row) const;

  Json manifest_, builds_ = Json::array(), measures_ = Json::array(), solids_ = Json::object();
  std::vector<Flag> exclude_;
  Aggregation aggregation_;
  std::map<std::string, Pool> pools_;  ///< by sweep point
  std::vector<Viewable> viewable_;
  std::vector<std::string> entries_;  ///< the members of each replicate's object but for name and row
};

}  // namespace isojam
