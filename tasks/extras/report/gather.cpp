#include "tasks/extras/report/gather.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "engine/analysis/power_law.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/straight_line.hpp"
#include "tasks/extras/report/angle_curves.hpp"
#include "tasks/extras/report/distributions.hpp"
#include "tasks/io/options.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/measure/shared_parts.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/tables/lines.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

using Members = std::vector<const RecordedReplicate*>;

/// Value at a JSON pointer, or null if it is missing: a report shows what exists.
Json value_at(const Json& json, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  return json.contains(place) ? json.at(place) : Json(nullptr);
}

Json number_at(const Json& json, const std::string& pointer) {
  auto value = value_at(json, pointer);
  return value.is_number() ? value : Json(nullptr);
}

Json text_at(const Json& json, const std::string& pointer) {
  const auto value = value_at(json, pointer);
  if (value.is_null()) return nullptr;
  return value.is_string() ? value : Json(value.dump());
}

Json list_at(const Json& json, const std::string& pointer) {
  auto value = value_at(json, pointer);
  return value.is_array() ? value : Json(Json::array());
}

std::vector<double> numbers_at(const Json& json, const std::string& pointer) {
  std::vector<double> numbers;
  for (const auto& value : list_at(json, pointer)) {
    if (value.is_number()) numbers.push_back(value.get<double>());
  }
  return numbers;
}

void add_distinct(Json& list, const Json& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

std::string label_of(const Row& row) {
  auto label = fmt::format("{}, N = {}", to_string(row.solid), row.particles);
  for (const auto& item : row.parameters.items()) {
    label += fmt::format(", {} {}", parameter_head(item.key()), parameter_text(row, item.key()));
  }
  return label;
}

std::string point_of(const RecordSummary& summary) {
  return point_text(summary.solid, summary.particles, summary.parameters);
}

std::string point_of(const Row& row) { return point_text(row.solid, row.particles, row.parameters); }

double sixth_root(double energy) { return energy > 0 ? nearest::cbrt(std::sqrt(energy)) : 0; }

/// Quantities of a state that the charts show as functions of Δφ.
constexpr std::array drawn_quantities{"Z", "Z_ff", "Z_ef", "Z_l", "C", "omega_l", "omega_h", "K", "G"};

Json state_points(const Json& record) {
  Json points = Json::array();
  for (const auto& state : list_at(record, "/states")) {
    const auto energy = number_at(state, "/energy_per_particle");
    Json point;
    point["density"] = number_at(state, "/density");
    point["delta_phi"] = number_at(state, "/delta_phi");
    point["root"] = energy.is_null() ? energy : Json(sixth_root(energy.get<double>()));
    for (const auto* name : drawn_quantities) point[name] = number_at(state, std::string(quantity(name).pointer));
    points.push_back(std::move(point));
  }
  return points;
}

/// The line that was fitted to obtain φ_J, from φ_J to the farthest fitted state. Null if it cannot be drawn.
Json extrapolation(const Json& record) {
  const auto states = state_points(record);
  std::vector<double> roots, densities;
  for (const double index : numbers_at(record, "/phi_j/states")) {
    if (index < 0 || index >= static_cast<double>(states.size())) return nullptr;
    const auto& state = states[static_cast<std::size_t>(index)];
    if (state.at("root").is_null() || state.at("density").is_null()) return nullptr;
    roots.push_back(state.at("root").get<double>());
    densities.push_back(state.at("density").get<double>());
  }
  const auto phi_j = number_at(record, "/phi_j/phi_j");
  if (phi_j.is_null() || roots.empty()) return nullptr;
  const auto [least, greatest] = std::minmax_element(roots.begin(), roots.end());
  if (*least == *greatest) return nullptr;
  const auto line = fit_line(roots, densities);
  return {{"from", {phi_j, 0}}, {"to", {line.intercept + line.slope * *greatest, *greatest}}};
}

/// Numbers of minimisations by the reason why they stopped, separately for compression and decompression.
Json stop_counts(const Json& record) {
  std::map<std::pair<std::string, std::string>, int> counts;
  for (const auto& step : list_at(record, "/path")) {
    const auto stage = text_at(step, "/stage"), reason = text_at(step, "/stopped");
    if (!stage.is_null() && !reason.is_null()) ++counts[{stage.get<std::string>(), reason.get<std::string>()}];
  }
  Json list = Json::array();
  for (const auto& [key, count] : counts)
    list.push_back({{"stage", key.first}, {"reason", key.second}, {"count", count}});
  return list;
}

/// The flags that the manifest excludes, or the default flags if it has no list. Unknown names are ignored.
std::vector<Flag> exclude_of(const Json& manifest) {
  if (!value_at(manifest, "/exclude").is_array()) return usually_excluded();
  std::vector<Flag> flags;
  for (const auto& name : list_at(manifest, "/exclude")) {
    const auto flag = name.is_string() ? from_string<Flag>(name.get<std::string>()) : std::nullopt;
    if (flag) flags.push_back(*flag);
  }
  return flags;
}

/// Points (strain, stress divided by pressure) of a shear. Empty if the replicate was not sheared. The load first
/// increases in every step, and then decreases.
Json shear_points(const Json& record) {
  Json points = Json::array();
  double before = -std::numeric_limits<double>::infinity();
  bool unloading = false;
  for (const auto& state : list_at(record, "/shear/path")) {
    const auto load = number_at(state, "/load");
    if (!load.is_null()) {
      unloading |= load.get<double>() < before;
      before = load.get<double>();
    }
    const auto stress = number_at(state, "/stress"), pressure = number_at(state, "/pressure");
    const bool known = !stress.is_null() && !pressure.is_null() && pressure.get<double>() > 0;
    Json point;
    point["strain"] = number_at(state, "/strain");
    point["stress"] = known ? Json(stress.get<double>() / pressure.get<double>()) : Json(nullptr);
    point["dropped"] = value_at(state, "/dropped") == Json(true);
    point["unloading"] = unloading;
    points.push_back(std::move(point));
  }
  return points;
}

/// The nearest state, which alone has angles and a density of states. Null if the replicate failed.
Json nearest_state(const Json& record) {
  const auto nearest = number_at(record, "/nearest");
  return nearest.is_null() ? Json(nullptr) : value_at(record, "/states/" + std::to_string(nearest.get<int>()));
}

Json replicate_entry(const RecordedReplicate& replicate, int row, const std::vector<Flag>& exclude) {
  const auto& record = replicate.record;
  Json json;
  json["name"] = replicate.name;
  json["row"] = row;
  json["replicate"] = replicate.summary.replicate;
  json["status"] = replicate.summary.failed ? "failed" : "done";
  json["flags"] = Json::array();
  for (const auto& flag : list_at(record, "/flags"))
    json["flags"].push_back(flag.is_string() ? flag : Json(flag.dump()));
  json["excluded"] = has_any(replicate.summary, exclude);
  json["failure"] = nullptr;
  if (replicate.summary.failed)
    json["failure"] = {{"where", text_at(record, "/failure/where")}, {"why", text_at(record, "/failure/why")}};
  json["phi_j"] = number_at(record, "/phi_j/phi_j");
  json["fit_half_width"] = number_at(record, "/phi_j/ci95_half_width");
  json["cpu_seconds"] = number_at(record, "/timing/cpu_seconds");
  json["evaluations"] = number_at(record, "/evaluations");
  json["states"] = state_points(record);
  json["line"] = extrapolation(record);
  json["stops"] = stop_counts(record);
  json["density_of_states"] = nullptr;
  const auto nearest = nearest_state(record);
  for (const std::string key : {"log10_omega", "density"}) {
    const auto list = numbers_at(nearest, "/modes/density_of_states/" + key);
    if (!list.empty()) json["density_of_states"][key] = list;
  }
  json["lowest"] = numbers_at(nearest, "/modes/lowest/omega");
  json["highest"] = numbers_at(nearest, "/modes/highest/omega");
  json["shear"] = shear_points(record);
  return json;
}

/// The stopping rule of the manifest; nullopt if it has none.
std::optional<Replicates> rule_of(const Json& manifest) {
  const auto min = number_at(manifest, "/replicates/min"), max = number_at(manifest, "/replicates/max");
  const auto aim = number_at(manifest, "/replicates/half_width"), name = text_at(manifest, "/replicates/quantity");
  if (!min.is_number_integer() || !max.is_number_integer() || aim.is_null() || name.is_null()) return std::nullopt;
  if (!quantity_index(name.get<std::string>())) return std::nullopt;
  return Replicates{min.get<int>(), max.get<int>(), Goal{name.get<std::string>(), aim.get<double>()}};
}

/// The base of the manifest, see base.hpp; empty if it has none.
Json base_of(const Json& manifest) {
  auto base = value_at(manifest, "/base");
  return base.is_object() ? base : Json(Json::object());
}

/// The replicates that neither failed nor are excluded.
Members counting(const Members& members, const std::vector<Flag>& exclude) {
  Members list;
  std::copy_if(members.begin(), members.end(), std::back_inserter(list), [&](const RecordedReplicate* member) {
    return !member->summary.failed && !has_any(member->summary, exclude);
  });
  return list;
}

/// Distributions of the angles over the contacts of all replicates. Null if no replicate has angles.
Json pooled_angles(const Members& members) {
  Json json;
  for (const std::string kind : {"face_face", "edge_face"}) {
    std::vector<double> angles, cutoffs;
    int replicates = 0;
    for (const auto* member : members) {
      const auto state = nearest_state(member->record);
      auto more = numbers_at(state, "/contacts/angles/" + kind);
      replicates += more.empty() ? 0 : 1;
      angles.insert(angles.end(), more.begin(), more.end());
      const auto cutoff = number_at(state, "/contacts/" + kind + "_fit/cutoff");
      if (!cutoff.is_null()) cutoffs.push_back(cutoff.get<double>() * 180 / std::numbers::pi);
    }
    if (angles.empty()) return nullptr;
    std::sort(cutoffs.begin(), cutoffs.end());
    json[kind] = {{"cdf", thinned_cdf(angles)}, {"contacts", angles.size()}, {"replicates", replicates}};
    json[kind]["cutoff"] = cutoffs.empty() ? Json(nullptr) : Json(cutoffs[cutoffs.size() / 2]);
  }
  return json;
}

/// Fit ⟨ω⟩ ∝ Δφ^x to the states of all replicates near jamming. Null if there are too few states.
Json pooled_scaling(const Members& members, const std::string& key) {
  std::vector<double> distances, values;
  for (const auto* member : members) {
    for (const auto& state : state_points(member->record)) {
      if (state.at(key).is_null() || state.at("delta_phi").is_null()) continue;
      const double distance = state.at("delta_phi").get<double>();
      if (distance <= 0 || distance > scaling_window) continue;
      distances.push_back(distance);
      values.push_back(state.at(key).get<double>());
    }
  }
  const auto law = fit_power_law(distances, values);
  if (!law) return nullptr;
  const auto [nearest, farthest] = std::minmax_element(distances.begin(), distances.end());
  Json json{{"exponent", law->exponent}, {"prefactor", law->prefactor}, {"points", law->points}};
  json["ci95_half_width"] = law->points > 2 ? Json(law->ci95_half_width) : Json(nullptr);
  json["from"] = *nearest;
  json["to"] = *farthest;
  return json;
}

Json row_entry(const Row& row, const Members& chosen) {
  Json json = to_json(row);
  json["label"] = label_of(row);
  const auto paper = paper_density(row.solid, row.particles);
  json["paper"] = nullptr;
  if (paper) json["paper"] = {{"phi_j", paper->phi_j}, {"half_width", paper->half_width}};
  json["scaling"] = {{"omega_l", pooled_scaling(chosen, "omega_l")}, {"omega_h", pooled_scaling(chosen, "omega_h")}};
  json["angles"] = pooled_angles(chosen);
  std::vector<Json> nearest;
  for (const auto* member : chosen) nearest.push_back(nearest_state(member->record));
  json["distributions"] = pooled_distributions(nearest);
  return json;
}

Json provenance_list(const Results& results) {
  Json builds = Json::array();
  for (const auto& replicate : results.replicates) {
    Json build;
    for (const std::string key : {"version", "git", "compiler", "seed"})
      build[key] = text_at(replicate.record, "/provenance/" + key);
    add_distinct(builds, build);
  }
  return builds;
}

Json measure_list(const Results& results) {
  Json measures = Json::array();
  for (const auto& replicate : results.replicates) {
    for (const auto& measure : list_at(replicate.record, "/spec/measure")) add_distinct(measures, measure);
  }
  return measures;
}

/// Measures that can still be added with "isojam measure".
Json addable_list(const Json& measures) {
  Json addable = Json::array();
  for (const auto name : all_names<Measure>) {
    if (std::find(measures.begin(), measures.end(), name) == measures.end()) addable.push_back(name);
  }
  return addable;
}

Json column_list() {
  Json columns = Json::array();
  for (const auto& quantity : all_quantities()) {
    columns.push_back(
        {{"name", quantity.name}, {"group", quantity.group.name}, {"unit", quantity.unit}, {"latex", quantity.latex}});
  }
  return columns;
}

Json solid_list(const Results& results) {
  Json solids = Json::object();
  for (const auto& replicate : results.replicates) {
    const auto name = std::string(to_string(replicate.summary.solid));
    if (solids.contains(name)) continue;
    const auto& mixture = replicate.summary.solid;
    solids[name] = mixture.is_one_solid() ? solid_shape(*mixture.solid()) : Json::object();
    solids[name].update(angle_references(mixture));
    if (mixture.is_one_solid()) continue;
    for (const auto& kind : mixture.kinds()) {
      solids[name]["shapes"].push_back(solid_shape(*kind.solid));
      solids[name]["shapes"].back()["name"] = kind.solid->name();
    }
  }
  return solids;
}

}  // namespace

Json report_data(const Results& results, const std::map<std::size_t, Json>& views) {
  const auto exclude = exclude_of(results.manifest);
  Aggregation aggregation(exclude, base_of(results.manifest));
  std::map<std::string, Members> points;
  for (const auto& replicate : results.replicates) {
    aggregation.add(replicate.summary);
    points[point_of(replicate.summary)].push_back(&replicate);
  }
  const auto table = aggregation.table(rule_of(results.manifest));

  Json data;
  data["manifest"] = {{"name", text_at(results.manifest, "/name")}, {"seed", text_at(results.manifest, "/seed")}};
  data["exclude"] = option_json(exclude);
  data["builds"] = provenance_list(results);
  data["measures"] = measure_list(results);
  data["addable"] = addable_list(data["measures"]);
  data["keeps_paths"] = value_at(results.manifest, "/keep_path") == true;
  data["columns"] = column_list();
  data["parameters"] = Json::object();
  for (const auto& name : parameter_names(table)) data["parameters"][name] = parameter_head(name);
  data["rows"] = Json::array();
  std::map<std::string, int> place;
  for (const auto& row : table.rows) {
    const auto point = point_of(row);
    place.emplace(point, static_cast<int>(place.size()));
    data["rows"].push_back(row_entry(row, counting(points.at(point), exclude)));
  }
  data["base"] = difference_title(table);
  data["csv"] = to_csv(table);
  data["latex"] = to_latex(table);
  data["replicates"] = data["views"] = Json::array();
  for (const auto& replicate : results.replicates)
    data["replicates"].push_back(replicate_entry(replicate, place.at(point_of(replicate.summary)), exclude));
  data["solids"] = solid_list(results);
  for (const auto& [replicate, view] : views) {
    data["views"].push_back(view);
    data["views"].back()["name"] = results.replicates[replicate].name;
  }
  return data;
}

}  // namespace isojam
