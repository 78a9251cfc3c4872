#include "tasks/extras/report/gather.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "engine/analysis/power_law.hpp"
#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/straight_line.hpp"
#include "tasks/extras/page/page.hpp"
#include "tasks/io/options.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/measure/shared_parts.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/tables/lines.hpp"
#include "tasks/tables/tables.hpp"

namespace isojam {
namespace {

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
Json extrapolation(const Json& record, const Json& states) {
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

/// The data of a replicate but for its name and its row.
Json replicate_entry(const RecordedReplicate& replicate, const Json& nearest, bool excluded) {
  const auto& record = replicate.record;
  Json json;
  json["replicate"] = replicate.summary.replicate;
  json["status"] = replicate.summary.failed ? "failed" : "done";
  json["flags"] = Json::array();
  for (const auto& flag : list_at(record, "/flags"))
    json["flags"].push_back(flag.is_string() ? flag : Json(flag.dump()));
  json["excluded"] = excluded;
  json["failure"] = nullptr;
  if (replicate.summary.failed)
    json["failure"] = {{"where", text_at(record, "/failure/where")}, {"why", text_at(record, "/failure/why")}};
  json["phi_j"] = number_at(record, "/phi_j/phi_j");
  json["fit_half_width"] = number_at(record, "/phi_j/ci95_half_width");
  json["cpu_seconds"] = number_at(record, "/timing/cpu_seconds");
  json["evaluations"] = number_at(record, "/evaluations");
  json["states"] = state_points(record);
  json["line"] = extrapolation(record, json["states"]);
  json["stops"] = stop_counts(record);
  json["density_of_states"] = nullptr;
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

Json provenance_of(const Json& record) {
  Json build;
  for (const std::string key : {"version", "git", "compiler", "seed"})
    build[key] = text_at(record, "/provenance/" + key);
  return build;
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

Json solid_of(const Mixture& mixture) {
  Json solid = mixture.is_one_solid() ? solid_shape(*mixture.solid()) : Json::object();
  solid.update(angle_references(mixture));
  if (mixture.is_one_solid()) return solid;
  for (const auto& kind : mixture.kinds()) {
    solid["shapes"].push_back(solid_shape(*kind.solid));
    solid["shapes"].back()["name"] = kind.solid->name();
  }
  return solid;
}

/// The text of an object without its braces.
std::string members(const Json& object) {
  const auto text = page_text(object);
  return text.substr(1, text.size() - 2);
}

}  // namespace

void ReportData::Scaling::add(const Json& states, const char* key) {
  for (const auto& state : states) {
    if (state.at(key).is_null() || state.at("delta_phi").is_null()) continue;
    const double distance = state.at("delta_phi").get<double>();
    if (distance <= 0 || distance > scaling_window) continue;
    distances.push_back(distance);
    values.push_back(state.at(key).get<double>());
  }
}

Json ReportData::Scaling::json() const {
  const auto law = fit_power_law(distances, values);
  if (!law) return nullptr;
  const auto [nearest, farthest] = std::minmax_element(distances.begin(), distances.end());
  Json json{{"exponent", law->exponent}, {"prefactor", law->prefactor}, {"points", law->points}};
  json["ci95_half_width"] = law->points > 2 ? Json(law->ci95_half_width) : Json(nullptr);
  json["from"] = *nearest;
  json["to"] = *farthest;
  return json;
}

void ReportData::Angles::add(const Json& nearest, const std::string& kind) {
  const auto angles = numbers_at(nearest, "/contacts/angles/" + kind);
  replicates += angles.empty() ? 0 : 1;
  for (const double angle : angles) cdf.add(angle);
  const auto cutoff = number_at(nearest, "/contacts/" + kind + "_fit/cutoff");
  if (!cutoff.is_null()) cutoffs.push_back(cutoff.get<double>() * 180 / std::numbers::pi);
}

Json ReportData::Angles::json() const {
  auto sorted = cutoffs;
  std::sort(sorted.begin(), sorted.end());
  return {{"cdf", cdf.steps()},
          {"contacts", cdf.size()},
          {"replicates", replicates},
          {"cutoff", sorted.empty() ? Json(nullptr) : Json(sorted[sorted.size() / 2])}};
}

ReportData::ReportData(Json manifest)
    : manifest_(std::move(manifest)), exclude_(exclude_of(manifest_)), aggregation_(exclude_, base_of(manifest_)) {}

void ReportData::add(const RecordedReplicate& replicate, const std::string& name) {
  const auto& [summary, record] = std::tie(replicate.summary, replicate.record);
  aggregation_.add(summary);
  add_distinct(builds_, provenance_of(record));
  for (const auto& measure : list_at(record, "/spec/measure")) add_distinct(measures_, measure);
  const auto solid = std::string(to_string(summary.solid));
  if (!solids_.contains(solid)) solids_[solid] = solid_of(summary.solid);
  viewable_.push_back({name, point_of(summary), summary.particles, summary.failed, summary.flagged});
  const bool excluded = has_any(summary, exclude_);
  const auto nearest = nearest_state(record);
  const auto entry = replicate_entry(replicate, nearest, excluded);
  entries_.push_back(members(entry));
  auto& pool = pools_[viewable_.back().point];
  if (summary.failed || excluded) return;
  for (auto& [key, scaling] : pool.scaling) scaling.add(entry.at("states"), key);
  for (auto& [kind, angles] : pool.angles) angles.add(nearest, kind);
  pool.distributions.add(nearest, summary.angles);
}

Json ReportData::row_entry(const Row& row) const {
  const auto& pool = pools_.at(point_of(row));
  Json json = to_json(row);
  json["label"] = label_of(row);
  const auto paper = paper_density(row.solid, row.particles);
  json["paper"] = nullptr;
  if (paper) json["paper"] = {{"phi_j", paper->phi_j}, {"half_width", paper->half_width}};
  for (const auto& [key, scaling] : pool.scaling) json["scaling"][key] = scaling.json();
  const bool all = std::ranges::all_of(pool.angles, [](const auto& kind) { return kind.second.cdf.size() > 0; });
  json["angles"] = nullptr;
  for (const auto& [kind, angles] : pool.angles) {
    if (all) json["angles"][kind] = angles.json();
  }
  json["distributions"] = pool.distributions.json();
  return json;
}

std::string ReportData::text(const std::vector<std::string>& views, const Json& more) {
  const auto table = aggregation_.table(rule_of(manifest_));
  Json data;
  data["manifest"] = {{"name", text_at(manifest_, "/name")}, {"seed", text_at(manifest_, "/seed")}};
  data["exclude"] = option_json(exclude_);
  data["builds"] = builds_;
  data["measures"] = measures_;
  data["addable"] = addable_list(measures_);
  data["keeps_paths"] = value_at(manifest_, "/keep_path") == true;
  data["columns"] = column_list();
  data["parameters"] = Json::object();
  for (const auto& name : parameter_names(table)) data["parameters"][name] = parameter_head(name);
  data["rows"] = Json::array();
  std::map<std::string, std::size_t> place;
  for (const auto& row : table.rows) {
    place.emplace(point_of(row), place.size());
    data["rows"].push_back(row_entry(row));
  }
  data["base"] = difference_title(table);
  data["csv"] = to_csv(table);
  data["latex"] = to_latex(table);
  auto text = fmt::format("{{{},\"views\":[{}],\"replicates\":[", members(data), fmt::join(views, ","));
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const auto& [name, point] = std::tie(viewable_[k].name, viewable_[k].point);
    text += fmt::format("{}{{\"name\":{},\"row\":{},{}}}", k > 0 ? "," : "", page_text(name), place.at(point),
                        std::exchange(entries_[k], {}));
  }
  Json rest{{"solids", solids_}};
  rest.update(more);
  return text + "]," + members(rest) + "}";
}

}  // namespace isojam
