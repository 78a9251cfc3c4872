#include <numbers>

#include "engine/analysis/alignment/critical_angles.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/measure/trough_parts.hpp"
#include "tasks/tables/tables.hpp"

// The description of tables.json, from which it is written. The program does not read it, so members have no readers.

namespace isojam {
namespace {

/// A value that is only written.
Custom output(std::function<Json()> write, Json schema, std::string kind) {
  return {std::move(write), nullptr, std::move(schema), std::move(kind)};
}

const Json count_schema{{"type", "integer"}, {"minimum", 0}};

Custom number_or_null(const std::optional<double>& value) {
  return output([&value] { return value ? Json(*value) : Json(nullptr); }, {{"type", {"number", "null"}}},
                "number or null");
}

Custom interval_or_null(const std::optional<Interval>& interval) {
  return output(
      [&interval] {
        return interval ? Json{interval->low, interval->high} : Json(nullptr);
      },
      {{"type", {"array", "null"}}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}},
      "list of two numbers, or null");
}

void describe_estimate(Fields& field, Estimate& estimate) {
  field.type(
      "estimate",
      "Mean of a quantity, with its uncertainty. It is a mean over the replicates that are not excluded and have "
      "a value; in `all`, over all replicates that have a value; in `differences`, over pairs of replicates.");
  field.custom("mean", number_or_null(estimate.mean), "Mean of the values; null if there is no value.").nulls();
  field
      .custom("ci95", interval_or_null(estimate.ci95),
              "Lower and upper end of the 95 % confidence interval of the mean; null with fewer than two values. The "
              "method is Student's t, unless `interval` states another one.")
      .nulls();
  field
      .custom("half_width", number_or_null(estimate.half_width),
              "Half of the width of `ci95`; null with fewer than two values.")
      .nulls();
  field
      .custom("sd", number_or_null(estimate.sd),
              "Standard deviation of the values, with n − 1 degrees of freedom; null with fewer than two values.")
      .nulls();
  field("n", estimate.n, "Number n of values.");
  field
      .custom(
          "bootstrap95", interval_or_null(estimate.bootstrap95),
          "95 % bootstrap-t interval of the mean, from 2000 resamples with a fixed seed. For skewed values, it "
          "contains the true mean more often than Student's interval. Null for proportions, with fewer than 8 values, "
          "with more than 1000 values, and if so many values are equal that the interval would be infinite.")
      .nulls();
  const auto method = [&estimate] {
    return estimate.method == IntervalMethod::student ? Json(nullptr) : Json(to_string(estimate.method));
  };
  field
      .custom(
          "interval", output(method, {{"enum", {"stein", "wilson"}}}, "`stein` or `wilson`"),
          "Method of `ci95`, if it is not Student's t. `stein`: Stein's method, for the quantity of a stopping rule; "
          "`wilson`: Wilson's interval, for a proportion, which is not symmetric about the mean.")
      .optional();
  const auto reason = [&estimate] {
    return estimate.n > 1    ? Json(nullptr)
           : estimate.n == 0 ? Json("no replicate that counts has this value")
                             : Json("one replicate has no spread");
  };
  field
      .custom("reason", output(reason, {{"type", "string"}}, "text"),
              "Reason why fields of this estimate are null; present if n is 0 or 1.")
      .optional();
}

/// Adds an object that is absent unless `is_there`.
void add_object(Fields& field, const Words& key, bool is_there, const std::function<void(Fields&)>& describe_it,
                const Words& meaning) {
  const auto write = [is_there, describe_it] {
    Fields inner;
    if (is_there) describe_it(inner);
    return is_there ? written(inner) : Json(nullptr);
  };
  field.custom(key, {write, nullptr, nullptr, "", describe_it}, meaning).optional();
}

void add_estimate(Fields& field, const Words& key, Estimate& estimate, bool is_there, const Words& meaning) {
  add_object(
      field, key, is_there, [&estimate](Fields& inner) { describe_estimate(inner, estimate); }, meaning);
}

/// Adds all quantities of the first group, and those quantities of the other groups that have a value. Their meanings
/// are stated once, in the row.
void add_estimates(Fields& field, Estimates& estimates, bool with_meanings) {
  const auto quantities = all_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i)
    add_estimate(field, quantities[i].name, estimates[i], is_always_listed(quantities[i]) || estimates[i].n > 0,
                 with_meanings ? quantities[i].meaning : "");
}

void add_estimates_with_values(Fields& field, Estimates& estimates, std::optional<Quantity::Of> of) {
  const auto quantities = all_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (!of || quantities[i].of == *of) add_estimate(field, quantities[i].name, estimates[i], estimates[i].n > 0, "");
  }
}

void describe_trough(Fields& field, PooledTrough& trough) {
  field.type(
      "pooled_trough",
      "Troughs in the densities of the alignment angles of all replicates together, and contact numbers with the "
      "cut-offs in these troughs. Replicates that failed or are excluded do not count.");
  field("replicates", trough.replicates, "Number of replicates whose angles are combined.");
  const auto add_trough = [&](const char* key, const Trough& of, const char* meaning) {
    const auto describe_it = [&of, &trough](Fields& inner) {
      static thread_local TroughRecord record;
      record = trough_record(of, trough.particles);
      describe(inner, record);
    };
    add_object(field, key, true, describe_it, meaning);
  };
  add_trough("face_face", trough.cutoffs.face_face,
             "Trough of the density of θ_ff. It gives the cut-off of face-face contacts.");
  add_trough("edge_face", trough.cutoffs.edge_face,
             "Trough of the density of θ_ef of the contacts that are not face-face. It gives the cut-off of edge-face "
             "contacts.");
  constexpr std::array<const char*, 6> meanings{
      "Mean number of face-face contacts per particle.",
      "Mean number of edge-face contacts per particle.",
      "Mean number of lower-order contacts per particle.",
      "Mean constraint number.",
      "Mean constraint number with both cut-offs at the lower edges of the troughs. (`C_high` − `C_low`)/2 is the "
      "systematic error of C from the width of the troughs.",
      "Mean constraint number with both cut-offs at the upper edges of the troughs."};
  for (std::size_t i = 0; i < PooledTrough::names.size(); ++i) {
    // The names of the estimates are without `pooled`, which is a part of the key of this object.
    auto name = std::string(PooledTrough::names[i]);
    add_estimate(field, name.erase(name.find("_pooled"), 7), trough.estimates[i], true, meanings[i]);
  }
}

void add_trough_of(Fields& field, std::optional<PooledTrough>& trough) {
  static PooledTrough none;
  add_object(
      field, "pooled_trough", trough.has_value(),
      [&of = trough ? *trough : none](Fields& inner) { describe_trough(inner, of); },
      "Contact classes with cut-offs in the troughs of the angles of all replicates together. In a series, the numbers "
      "in the histogram of a replicate are interpolated like its quantities. Absent if no record has histograms of "
      "angles.");
}

constexpr const char* all_meaning =
    "Estimates that include the excluded replicates. Absent if no replicate is excluded.";

void describe_series(Fields& field, SeriesPoint& point, bool with_all) {
  field("delta_phi", point.delta_phi, "Distance to jamming, Δφ = φ − φ_J.").finite();
  add_estimates_with_values(field, point.estimates, Quantity::Of::state);
  add_trough_of(field, point.trough);
  add_object(
      field, "all", with_all,
      [&point](Fields& inner) { add_estimates_with_values(inner, point.all, Quantity::Of::state); }, all_meaning);
}

void describe_goal(Fields& field, GoalOutcome& outcome) {
  field("quantity", outcome.goal.quantity, "Quantity whose confidence interval the stopping rule checks.");
  field("aim", outcome.goal.half_width,
        "Goal of the stopping rule: the requested half width of the confidence interval.")
      .range({0, not_negative.high, true})
      .finite();
  field
      .custom(
          "reached", number_or_null(outcome.half_width),
          "Half width of the confidence interval at the last check; null if the rule was not checked yet, or if there "
          "were fewer than two values.")
      .nulls();
  field("met", outcome.met, "True if `reached` is at most `aim`, and not all values are equal.");
  field
      .custom("needed",
              output([&outcome] { return outcome.needed ? Json(*outcome.needed) : Json(nullptr); },
                     {{"type", {"integer", "null"}}}, "integer or null"),
              "Number of replicates after which the stopping rule ended; null if it has not ended yet.")
      .nulls();
  field.custom("first", output([&outcome] { return outcome.first.size(); }, count_schema, "integer ≥ 0"),
               "Number of values at the first check at which not all values are equal. The confidence interval at each "
               "check uses the standard deviation of these values (Stein's method). The field is 0 if the rule was not "
               "checked yet, or if the quantity is a proportion.");
}

void describe_differences(Fields& field, Differences& differences) {
  field("pairs", differences.pairs,
        "Number of pairs that are used. A pair is not used if one of its two replicates failed or is excluded.");
  add_estimates_with_values(field, differences.estimates, std::nullopt);
}

/// Critical angles in degrees.
void describe_critical_angles(Fields& field, const Mixture& solid) {
  const auto angles = critical_angles(solid);
  const auto add = [&](const char* key, double angle, const char* meaning) {
    field
        .custom(key,
                output([angle] { return angle * 180 / std::numbers::pi; },
                       {{"type", "number"}, {"minimum", 0}, {"maximum", 180}}, "number"),
                meaning)
        .unit("degrees");
  };
  add("ef_vertex_face", angles.ef_vertex_face, "Critical angle θ_ef of a vertex on a face.");
  add("ef_edge_edge", angles.ef_edge_edge, "Critical angle θ_ef of two crossed edges.");
  add("ff_vertex_face", angles.ff_vertex_face, "Critical angle θ_ff of a vertex on a face.");
  add("ff_edge_edge", angles.ff_edge_edge, "Critical angle θ_ff of two crossed edges.");
  add("ff_edge_face", angles.ff_edge_face, "Critical angle θ_ff of an edge in a face.");
}

void describe_counts(Fields& field, Row& row) {
  field.custom("solid", output([&row] { return to_string(row.solid); }, {{"type", "string"}}, "text"),
               "Name of the solid, or of the mixture.");
  field("particles", row.particles, "Number N of particles.");
  field.custom("parameters", output([&row] { return row.parameters; }, {{"type", "object"}}, "object"),
               "Values of the swept parameters, without `solid` and `particles`.");
  field("replicates", row.replicates, "Number of recorded replicates, including failed ones.");
  field("failed", row.failed, "Number of failed replicates. No estimate includes them.");
  field("flagged", row.flagged, "Number of replicates that have a flag. A failed replicate has no flag.");
  field("excluded", row.excluded, "Number of replicates that have at least one of the flags in `exclude`.");
}

template <class T>
T& value_or_static(std::optional<T>& value) {
  static T none{};
  return value ? *value : none;
}

}  // namespace

void describe(Fields& field, Row& row) {
  describe_counts(field, row);
  add_object(
      field, "goal", row.goal.has_value(),
      [&of = value_or_static(row.goal)](Fields& inner) { describe_goal(inner, of); },
      "Progress of the stopping rule in this row. Absent if the manifest has no stopping rule, or if the tables "
      "combine "
      "manifests with different stopping rules.");
  add_estimates(field, row.estimates, true);
  add_trough_of(field, row.trough);
  add_object(
      field, "all", row.excluded > 0, [&row](Fields& inner) { add_estimates(inner, row.all, false); }, all_meaning);
  add_object(
      field, "differences", row.differences.has_value(),
      [&of = value_or_static(row.differences)](Fields& inner) { describe_differences(inner, of); },
      "Paired differences: the value of a replicate of this row minus the value of the paired replicate of the base "
      "row, "
      "as a mean over all pairs. Paired replicates have the same number and use the same random numbers. Absent in a "
      "base row, and if no base was chosen.");
  field.nested(
      "critical_angles", [&row](Fields& inner) { describe_critical_angles(inner, row.solid); },
      "The largest alignment angles that the shape of the particles allows for given pairs of features that touch "
      "(Table "
      "II of the paper). They are computed from the shape, not measured. If vertices, edges or particles have "
      "different "
      "critical angles, the smallest is listed.");
  field
      .custom("residual", number_or_null(row.residual),
              "Largest residual of all states of this row to which φ_J was fitted; null if all replicates failed.")
      .nulls();
  const auto point = [&row](std::size_t k) {
    return MemberRef(Nested{[&row, k](Fields& inner) { describe_series(inner, row.series[k], row.excluded > 0); }});
  };
  const auto example = [] {
    static SeriesPoint any;
    return MemberRef(Nested{[](Fields& inner) { describe_series(inner, any, true); }});
  };
  field.list.push_back(
      {"series",
       "Estimates at fixed values of Δφ, in descending order of Δφ. The value of a replicate is "
       "interpolated between its two states around Δφ, linearly in ln Δφ. A replicate has no value at a "
       "Δφ outside the range of its states. If no replicate has a value, the quantity is left out.",
       Many{[&row] { return row.series.size(); }, nullptr, point, example}});
}

void describe(Fields& field, Table& table) {
  field.custom("schema", output([] { return table_schema; }, {{"const", table_schema}}, "text"),
               "Name and version of the file format.");
  static std::optional<std::string> no_checksum;
  field("checksum", no_checksum,
        "64-bit FNV-1a checksum of the text of the file. It is computed with zeros in place of the 16 digits of this "
        "field.");
  field.custom(
      "builds",
      output([&table] { return table.builds; }, {{"type", "array"}, {"items", {{"type", "string"}}}}, "list: text"),
      "Builds of isojam that made the records. Each text has the version, the commit and the compiler.");
  field("exclude", table.exclude,
        "Flags that exclude a replicate. The stopping rule ignores excluded replicates. Only the estimates in the "
        "objects "
        "`all` include them.");
  field
      .custom(
          "base",
          output([&table] { return table.base.empty() ? Json(nullptr) : table.base; }, {{"type", "object"}}, "object"),
          "Values of swept parameters that select the base rows. The base row with which a row is compared has these "
          "values. Its solid, its number of particles and its other parameters are those of the row. Absent if no "
          "base was chosen.")
      .optional();
  const auto nearest_only = [&table] {
    Json json;
    for (const auto& [measure, replicates] : table.nearest_only) json[std::string(to_string(measure))] = replicates;
    return json;
  };
  field
      .custom(
          "nearest_only", output(nearest_only, {{"type", "object"}, {"additionalProperties", count_schema}}, "object"),
          "For each measure that was added to replicates without paths, the number of these replicates. The measure "
          "was computed only for their states nearest jamming, so the series do not contain values of these "
          "replicates.")
      .optional();
  field("rows", table.rows, "One row for each sweep point, ordered by solid, particles and parameters.");
}

Json to_json(const Row& row) { return written(row); }
Json to_json(const Table& table) { return written(table); }

}  // namespace isojam
