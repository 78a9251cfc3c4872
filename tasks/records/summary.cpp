#include "tasks/records/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "tasks/io/place.hpp"
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

void read_values(const JsonPlace& root, RecordSummary& summary) {
  const auto nearest = root.at("nearest");
  const auto quantities = all_quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const bool of_replicate = quantities[i].of == Quantity::Of::replicate;
    summary.values[i] = quantity_value(of_replicate ? root : nearest, quantities[i]);
  }
  summary.angles = angles_of(nearest);
  summary.residual = number_or_null(root.at("phi_j").at("residual"));
}

void read_states(const JsonPlace& states, RecordSummary& summary) {
  const auto quantities = all_quantities();
  const auto count = states.expect_list(list_of_states);
  for (std::size_t k = 0; k < count; ++k) {
    const auto state = states.at(k);
    const auto distance = number_or_null(state.at("delta_phi"));
    if (!distance || *distance <= 0) continue;
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

std::string build_text(const JsonPlace& place) {
  return fmt::format("{} ({}, {})", place.at("version").text(), place.at("git").text(), place.at("compiler").text());
}

void read_additions(const JsonPlace& added, RecordSummary& summary) {
  const auto count = added.expect_list("a list of added measures");
  for (std::size_t k = 0; k < count; ++k) {
    const auto before = added.at(k).at("before");
    summary.before.push_back(
        {before.at("manifest_digest").text(), before.at("result_digest").text(), build_text(added.at(k))});
  }
}

/// Reads a list of measures. Measures that this version does not know are ignored.
std::vector<Measure> read_measures(const JsonPlace& measures) {
  std::vector<Measure> list;
  const auto count = measures.expect_list("a list of measures");
  for (std::size_t k = 0; k < count; ++k) {
    if (const auto measure = from_string<Measure>(measures.at(k).text())) list.push_back(*measure);
  }
  return list;
}

void read_flags(const JsonPlace& flags, RecordSummary& summary) {
  summary.flagged = flags.expect_list("a list of flags") > 0;
  for (const auto& name : flags.value()) {
    const auto flag = name.is_string() ? from_string<Flag>(name.get_ref<const std::string&>()) : std::nullopt;
    if (flag) summary.flags.push_back(*flag);
  }
}

/// Throws unless the value is the name of this format.
void check_format(const JsonPlace& place, std::string_view format) {
  if (const auto theirs = place.text(); theirs != format)
    place.refuse_with_remedy(fmt::format("another version of isojam wrote this file, in the format {}", theirs),
                             "run its manifest again in another directory, or use that version");
}

}  // namespace

bool has_any(const RecordSummary& summary, const std::vector<Flag>& flags) {
  return std::find_first_of(summary.flags.begin(), summary.flags.end(), flags.begin(), flags.end()) !=
         summary.flags.end();
}

RecordSummary summarise_record(const Json& record, const std::string& file) {
  const JsonPlace root(record, file);
  check_format(root.at("schema"), record_schema);
  const auto spec = root.at("spec");
  RecordSummary summary;
  summary.solid = read_mixture(spec);
  summary.particles = static_cast<int>(spec.at("particles").integer({1, 1e9}));
  summary.parameters = spec.at("parameters").value();
  spec.at("parameters").expect_object("an object");
  summary.replicate = static_cast<int>(spec.at("replicate").integer({0, 1e9}));
  const auto provenance = root.at("provenance");
  summary.study = summary.manifest_digest = provenance.at("manifest_digest").text();
  summary.build = build_text(provenance);
  if (provenance.has("added")) read_additions(provenance.at("added"), summary);
  summary.measures = read_measures(spec.at("measure"));
  if (root.has("nearest_only")) summary.nearest_only = read_measures(root.at("nearest_only"));
  for (const std::string key : {"protocol", "minimiser", "measure", "modes"})
    summary.settings[key] = spec.at(key).value();
  const bool is_sheared =
      std::find(summary.measures.begin(), summary.measures.end(), Measure::shear) != summary.measures.end();
  if (is_sheared && spec.has("shear")) summary.settings["shear"] = spec.at("shear").value();
  summary.failed = root.at("status").choice(std::array<std::string_view, 2>{"done", "failed"}) == 1;
  if (summary.failed) {
    root.at("failure").at("where").text();
    root.at("failure").at("why").text();
  } else {
    read_values(root, summary);
    read_states(root.at("states"), summary);
    read_flags(root.at("flags"), summary);
  }
  summary.result_digest = root.at("result_digest").text();
  summary.cpu_seconds = root.at("timing").at("cpu_seconds").number({0, 1e12});
  return summary;
}

}  // namespace isojam
