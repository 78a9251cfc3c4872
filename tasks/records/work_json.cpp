#include "tasks/records/work_json.hpp"

#include <limits>

namespace isojam {
namespace {

long read_count(const JsonPlace& place) { return static_cast<long>(place.integer(count_range)); }

}  // namespace

Json to_json(const PairCounts& counts) {
  Json json;
  json["listed"] = counts.listed;
  json["out_of_reach"] = counts.out_of_reach;
  json["by_axis"] = counts.by_axis;
  json["overlapped"] = counts.overlapped;
  json["clipped"] = counts.clipped;
  json["touching"] = counts.touching;
  return json;
}

Json to_json(const MinimiseWork& work) {
  Json json;
  json["double_double_evaluations"] = work.double_double_evaluations;
  json["hessians"] = work.hessians;
  json["factorisations"] = work.factorisations;
  json["factor_updates"] = work.factor_updates;
  json["envelopes"] = work.envelopes;
  json["envelope_overlaps"] = work.envelope_overlaps;
  json["local_factorisations"] = work.local_factorisations;
  json["incomplete_factorisations"] = work.incomplete_factorisations;
  json["krylov_vectors"] = work.krylov_vectors;
  return json;
}

Json to_json(const Rearrangement& rearrangement) {
  Json json;
  json["energy_ratio"] = rearrangement.energy_ratio;
  json["contacts_lost"] = rearrangement.contacts_lost;
  json["contacts_gained"] = rearrangement.contacts_gained;
  json["particles_moved"] = rearrangement.particles_moved;
  return json;
}

PairCounts read_counts(const JsonPlace& place) {
  const auto count = [&](const std::string& key) { return read_count(place.at(key)); };
  return {count("listed"),     count("out_of_reach"), count("by_axis"),
          count("overlapped"), count("clipped"),      count("touching")};
}

MinimiseWork read_work(const JsonPlace& place) {
  const auto count = [&](const std::string& key) { return read_count(place.at(key)); };
  return {count("double_double_evaluations"),
          count("hessians"),
          count("factorisations"),
          count("factor_updates"),
          count("envelopes"),
          count("envelope_overlaps"),
          count("local_factorisations"),
          count("incomplete_factorisations"),
          count("krylov_vectors")};
}

Rearrangement read_rearrangement(const JsonPlace& place) {
  const auto contacts = [&](const std::string& key) { return static_cast<int>(place.at(key).integer({0, 1e9})); };
  return {place.at("energy_ratio").number(any_number), contacts("contacts_lost"), contacts("contacts_gained"),
          place.at("particles_moved").number(not_negative)};
}

}  // namespace isojam
