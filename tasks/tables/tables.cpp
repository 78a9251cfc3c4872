#include "tasks/tables/tables.hpp"

#include <numbers>

#include "engine/analysis/alignment/critical_angles.hpp"
#include "tasks/io/options.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/measure/trough_parts.hpp"

namespace isojam {
namespace {

Json to_json(const Estimate& estimate) {
  Json json;
  const auto put = [&](const std::string& key, const std::optional<double>& value) {
    json[key] = value ? Json(*value) : Json(nullptr);
  };
  const auto put_interval = [&](const std::string& key, const std::optional<Interval>& interval) {
    json[key] = interval ? Json{interval->low, interval->high} : Json(nullptr);
  };
  put("mean", estimate.mean);
  put_interval("ci95", estimate.ci95);
  put("half_width", estimate.half_width);
  put("sd", estimate.sd);
  json["n"] = estimate.n;
  put_interval("bootstrap95", estimate.bootstrap95);
  if (estimate.method != IntervalMethod::student) json["interval"] = to_string(estimate.method);
  if (estimate.n == 0) json["reason"] = "no replicate that counts has this value";
  if (estimate.n == 1) json["reason"] = "one replicate has no spread";
  return json;
}

/// Writes all quantities of the first group, and those quantities of the other groups that have a value.
void put_estimates(Json& json, const Estimates& estimates) {
  const auto quantities = all_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (!is_always_listed(quantities[i]) && estimates[i].n == 0) continue;
    json[std::string(quantities[i].name)] = to_json(estimates[i]);
  }
}

void put_state_estimates(Json& json, const Estimates& estimates) {
  const auto quantities = all_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (quantities[i].of == Quantity::Of::state && estimates[i].n > 0)
      json[std::string(quantities[i].name)] = to_json(estimates[i]);
  }
}

/// The names of the estimates are without `pooled`, which is a part of the key of this object.
Json to_json(const PooledTrough& trough) {
  Json json;
  json["replicates"] = trough.replicates;
  json["face_face"] = written(trough_record(trough.cutoffs.face_face, trough.particles));
  json["edge_face"] = written(trough_record(trough.cutoffs.edge_face, trough.particles));
  for (std::size_t i = 0; i < PooledTrough::names.size(); ++i) {
    auto name = std::string(PooledTrough::names[i]);
    json[name.erase(name.find("_pooled"), 7)] = to_json(trough.estimates[i]);
  }
  return json;
}

Json to_json(const SeriesPoint& point, bool with_all) {
  Json json;
  json["delta_phi"] = point.delta_phi;
  put_state_estimates(json, point.estimates);
  if (point.trough) json["pooled_trough"] = to_json(*point.trough);
  if (with_all) {
    json["all"] = Json::object();
    put_state_estimates(json["all"], point.all);
  }
  return json;
}

Json to_json(const Differences& differences) {
  Json json;
  json["pairs"] = differences.pairs;
  const auto quantities = all_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (differences.estimates[i].n > 0) json[std::string(quantities[i].name)] = to_json(differences.estimates[i]);
  }
  return json;
}

Json to_json(const GoalOutcome& outcome) {
  Json json;
  json["quantity"] = outcome.goal.quantity;
  json["aim"] = outcome.goal.half_width;
  json["reached"] = outcome.half_width ? Json(*outcome.half_width) : Json(nullptr);
  json["met"] = outcome.met;
  json["needed"] = outcome.needed ? Json(*outcome.needed) : Json(nullptr);
  json["first"] = outcome.first.size();
  return json;
}

/// Critical angles in degrees.
Json critical_angle_record(const Mixture& solid) {
  const auto angles = critical_angles(solid);
  const auto degrees = [](double angle) { return angle * 180 / std::numbers::pi; };
  Json json;
  json["ef_vertex_face"] = degrees(angles.ef_vertex_face);
  json["ef_edge_edge"] = degrees(angles.ef_edge_edge);
  json["ff_vertex_face"] = degrees(angles.ff_vertex_face);
  json["ff_edge_edge"] = degrees(angles.ff_edge_edge);
  json["ff_edge_face"] = degrees(angles.ff_edge_face);
  return json;
}

}  // namespace

Json to_json(const Row& row) {
  Json entry;
  entry["solid"] = to_string(row.solid);
  entry["particles"] = row.particles;
  entry["parameters"] = row.parameters;
  entry["replicates"] = row.replicates;
  entry["failed"] = row.failed;
  entry["flagged"] = row.flagged;
  entry["excluded"] = row.excluded;
  if (row.goal) entry["goal"] = to_json(*row.goal);
  put_estimates(entry, row.estimates);
  if (row.trough) entry["pooled_trough"] = to_json(*row.trough);
  if (row.excluded > 0) put_estimates(entry["all"], row.all);
  if (row.differences) entry["differences"] = to_json(*row.differences);
  entry["critical_angles"] = critical_angle_record(row.solid);
  entry["residual"] = row.residual ? Json(*row.residual) : Json(nullptr);
  entry["series"] = Json::array();
  for (const auto& point : row.series) entry["series"].push_back(to_json(point, row.excluded > 0));
  return entry;
}

Json to_json(const Table& table) {
  Json json;
  json["schema"] = table_schema;
  json["builds"] = table.builds;
  json["exclude"] = option_json(table.exclude);
  if (!table.base.empty()) json["base"] = table.base;
  for (const auto& [measure, replicates] : table.nearest_only)
    json["nearest_only"][std::string(to_string(measure))] = replicates;
  json["rows"] = Json::array();
  for (const auto& row : table.rows) json["rows"].push_back(to_json(row));
  return json;
}

}  // namespace isojam
