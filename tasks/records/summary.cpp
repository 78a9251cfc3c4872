#include "tasks/records/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tasks/io/place.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/measure/trough_parts.hpp"
#include "tasks/packings/mixture_json.hpp"
#include "tasks/records/record.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace {

std::optional<double> number_or_null(const JsonPlace& place) {
  if (place.value().is_null()) return std::nullopt;
  return place.number({-1e300, 1e300});
}

std::optional<double> value_below(const JsonPlace& place, std::string_view pointer) {
  if (pointer.empty()) return number_or_null(place);
  const auto end = std::min(pointer.find('/', 1), pointer.size());
  return value_below(place.at(std::string(pointer.substr(1, end - 1))), pointer.substr(end));
}

/// Value of a quantity. nullopt if its measure was not requested (the first key of the pointer is missing), if the
/// packing does not have so many kinds of particles or no cohesion. If another key is
/// missing, throws.
std::optional<double> quantity_value(const JsonPlace& place, const Quantity& quantity) {
  // Tables read millions of values. Only an unexpected value needs a JsonPlace, which contains texts for messages.
  const Json* value = &place.value();
  for (std::string_view rest = quantity.pointer; !rest.empty();) {
    const auto end = std::min(rest.find('/', 1), rest.size());
    const auto found = value->is_object() ? value->find(rest.substr(1, end - 1)) : value->end();
    if (found == value->end()) {
      const bool can_be_missing = quantity.kinds > 1 || quantity.cohesive;
      if (rest.size() == quantity.pointer.size() || can_be_missing) return std::nullopt;
      return value_below(place, quantity.pointer);
    }
    value = &*found;
    rest = rest.substr(end);
  }
  if (value->is_number_float()) return value->get<double>();
  return value_below(place, quantity.pointer);
}

std::optional<AngleHistogram> angles_of(const JsonPlace& state) {
  if (!state.value().contains(Json::json_pointer(std::string(angle_bins_pointer)))) return std::nullopt;
  return read_angle_histogram(state.at("contacts").at("angle_bins"));
}

void set_values(const JsonPlace& root, const Record& record, RecordSummary& summary) {
  const auto nearest = root.at("states").at(static_cast<std::size_t>(*record.nearest.value));
  const auto quantities = all_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const bool of_replicate = quantities[i].of == Quantity::Of::replicate;
    summary.values[i] = quantity_value(of_replicate ? root : nearest, quantities[i]);
  }
  summary.angles = angles_of(nearest);
  if (const double residual = record.phi_j.value->residual; std::isfinite(residual)) summary.residual = residual;
}

void set_states(const JsonPlace& states, const Record& record, RecordSummary& summary) {
  const auto quantities = all_quantities();
  for (std::size_t k = 0; k < record.states.size(); ++k) {
    const auto distance = record.states[k].delta_phi.value;
    if (!distance || *distance <= 0) continue;
    const auto state = states.at(k);
    StateValues values{*distance};
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      if (quantities[i].of == Quantity::Of::state) values.values[i] = quantity_value(state, quantities[i]);
    }
    values.angles = angles_of(state);
    summary.states.push_back(std::move(values));
  }
  std::sort(summary.states.begin(), summary.states.end(),
            [](const StateValues& a, const StateValues& b) { return a.delta_phi < b.delta_phi; });
}

template <class Origin>
std::string build_text(const Origin& origin) {
  return fmt::format("{} ({}, {})", origin.version, origin.git, origin.compiler);
}

/// Throws unless a done record has results and a failed one has a reason.
void check_status(const JsonPlace& root, const Record& record) {
  const bool failed = record.status == RecordStatus::failed;
  if (failed != record.failure.has_value())
    root.at("status").refuse(failed ? "a failed replicate has a failure" : "a done replicate has no failure");
  if (failed) return;
  if (!record.phi_j.value || !record.flags.value) root.at("phi_j").refuse("a done replicate has results");
  if (!record.nearest.value || static_cast<std::size_t>(*record.nearest.value) >= record.states.size())
    root.at("nearest").refuse("no state has this index");
}

}  // namespace

bool has_any(const RecordSummary& summary, const std::vector<Flag>& flags) {
  return std::find_first_of(summary.flags.begin(), summary.flags.end(), flags.begin(), flags.end()) !=
         summary.flags.end();
}

Record read_record_document(const Json& json, const std::string& file) {
  const JsonPlace root(json, file);
  if (const auto theirs = root.at("schema").text(); theirs != record_schema)
    root.at("schema").refuse_with_remedy(
        fmt::format("another version of isojam wrote this file, in the format {}", theirs),
        "run its manifest again in another directory, or use that version");
  auto record = read_document<Record>(json, file);
  check_status(root, record);
  return record;
}

RecordSummary summarise_record(const Json& json, const std::string& file) {
  return summarise_record(read_record_document(json, file), json, file);
}

RecordSummary summarise_record(const Record& record, const Json& json, const std::string& file) {
  const JsonPlace root(json, file);
  const auto spec = root.at("spec");
  RecordSummary summary;
  summary.solid = read_mixture(spec);
  summary.particles = static_cast<int>(spec.at("particles").integer({1, 1e9}));
  summary.parameters = spec.at("parameters").value();
  summary.replicate = static_cast<int>(spec.at("replicate").integer({0, 1e9}));
  summary.seed = record.provenance.seed;
  summary.spec_digest = spec_digest(record.spec, summary.seed);
  // Replicates from the same file are compared too, and those from different files are different replicates.
  summary.study = spec.has("start") ? fmt::format("{} {}", summary.seed, compact(spec.at("start").value()))
                                    : std::to_string(summary.seed);
  summary.build = build_text(record.provenance);
  for (const auto& addition : record.provenance.added.value_or(std::vector<Addition>{}))
    summary.before.push_back({addition.spec_digest, addition.result_digest, build_text(addition)});
  const auto& measures = spec.at("measure");
  for (std::size_t k = 0; k < measures.expect_list("a list of measures"); ++k)
    summary.measures.push_back(measures.at(k).choice<Measure>());
  summary.nearest_only = record.nearest_only.value_or(std::vector<Measure>{});
  for (const std::string key : {"protocol", "minimiser", "modes"}) summary.settings[key] = spec.at(key).value();
  const bool is_sheared =
      std::find(summary.measures.begin(), summary.measures.end(), Measure::shear) != summary.measures.end();
  if (is_sheared && spec.has("shear")) summary.settings["shear"] = spec.at("shear").value();
  summary.failed = record.status == RecordStatus::failed;
  summary.reached_limit = summary.failed && record.failure->why.starts_with(to_string(JamStatus::density_limit));
  if (!summary.failed) {
    set_values(root, record, summary);
    set_states(root.at("states"), record, summary);
    summary.flags = *record.flags.value;
    summary.flagged = !summary.flags.empty();
  }
  summary.result_digest = record.result_digest;
  summary.cpu_seconds = record.timing.cpu_seconds;
  return summary;
}

}  // namespace isojam
