#include "tasks/extras/export/record_rows.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "tasks/io/fields.hpp"
#include "tasks/measure/measure.hpp"
#include "tasks/tables/lines.hpp"

namespace isojam {
namespace {

constexpr std::string_view between = "; ";

/// Value at a JSON pointer into an object; null if it is missing.
const Json* value_at(const Json& object, std::string_view pointer) {
  const Json* value = &object;
  while (!pointer.empty()) {
    const auto end = std::min(pointer.find('/', 1), pointer.size());
    const auto found = value->is_object() ? value->find(pointer.substr(1, end - 1)) : value->end();
    if (found == value->end()) return nullptr;
    value = &*found;
    pointer = pointer.substr(end);
  }
  return value;
}

Json copy_of(const Json* value) { return value ? *value : Json(nullptr); }

/// Reason that the record states for a null value. It is stored beside the value or in an enclosing object.
std::string reason_of(const Json& object, std::string_view pointer) {
  for (auto end = pointer.size(); end != 0; end = pointer.rfind('/', end - 1)) {
    const auto* reason = value_at(object, std::string(pointer.substr(0, end)) + "_reason");
    if (reason && reason->is_string()) return reason->get<std::string>();
  }
  return "";
}

std::string joined_texts(const Json& list) {
  Cells cells;
  for (const auto& text : list) cells.push_back(text.get<std::string>());
  return joined(cells, between);
}

std::vector<std::string> swept_names(const std::optional<Manifest>& manifest, const RecordedReplicate& first) {
  std::vector<std::string> names;
  if (manifest) {
    for (const auto& [name, values] : manifest->swept) names.push_back(name);
  } else {
    for (const auto& item : first.summary.parameters.items()) names.push_back(item.key());
  }
  return names;
}

/// The largest number of kinds of particles in a packing of this study.
std::size_t kinds_of(const std::optional<Manifest>& manifest, const RecordedReplicate& first) {
  std::size_t most = first.summary.solid.kinds().size();
  for (const auto& solid : manifest ? manifest->solids : std::vector<Mixture>{})
    most = std::max(most, solid.kinds().size());
  return most;
}

std::vector<Measure> measures_of(const std::optional<Manifest>& manifest, const RecordedReplicate& first) {
  return manifest ? manifest->measures : first.summary.measures;
}

std::size_t nearest_of(const RecordedReplicate& held) { return static_cast<std::size_t>(*held.document.nearest.value); }

/// The fields of a state or a record, without those of its measures.
Fields without_measures(Fields fields) {
  for (const Measure measure : all_measures) {
    for (const auto& part : {definition_of(measure).state, definition_of(measure).replicate}) {
      for (const auto& entry : part.fields ? part.fields().list : std::vector<FieldEntry>{})
        std::erase_if(fields.list, [&](const FieldEntry& field) { return field.key == entry.key; });
    }
  }
  return fields;
}

/// True for a field of a kind of particles that no mixture of the study has. Single solids have no fields of kinds.
bool is_of_more_kinds(const std::string& pointer, std::size_t kinds) {
  constexpr std::string_view kind = "/kind_";
  const auto found = pointer.find(kind);
  return found != std::string::npos && (kinds == 1 || std::stoul(pointer.substr(found + kind.size())) > kinds);
}

}  // namespace

RecordRows::RecordRows(RowOf of, RowFormat format, const std::optional<Manifest>& manifest,
                       const RecordedReplicate& first)
    : of_(of), format_(format), exclude_(manifest ? manifest->exclude : usually_excluded()) {
  const auto measures = measures_of(manifest, first);
  const auto kinds = kinds_of(manifest, first);
  add_head(swept_names(manifest, first));
  add_fields(without_measures(fields_of<StateRow>()), Quantity::Of::state, kinds);
  add_quantities(measures, kinds);
  const auto add_part = [&](const MeasurePart& part, Quantity::Of what) {
    if (part.fields) add_fields(part.fields(), what, kinds);
  };
  for (const Measure measure : measures) {
    add_part(definition_of(measure).state, Quantity::Of::state);
    if (of_ == RowOf::replicate) add_part(definition_of(measure).replicate, Quantity::Of::replicate);
  }
  if (of_ == RowOf::replicate) add_fields(without_measures(fields_of<Record>()), Quantity::Of::replicate, kinds);
  add_text("reasons", [this](const Source& s) { return reasons(s); });
}

/// Some quantities have the same name as a number that every state has. The two are then equal, and only one is added.
void RecordRows::add(std::string name, Value value) {
  if (std::find(columns_.begin(), columns_.end(), name) != columns_.end()) return;
  columns_.push_back(std::move(name));
  values_.push_back(std::move(value));
}

void RecordRows::add_text(const std::string& name, Value value) {
  const auto before = columns_.size();
  add(name, std::move(value));
  if (columns_.size() > before) texts_.push_back(name);
}

void RecordRows::add_head(const std::vector<std::string>& parameters) {
  add_text("replicate", [](const Source& s) { return s.held.name; });
  add_text("solid", [](const Source& s) { return to_string(s.held.summary.solid); });
  add("particles", [](const Source& s) { return s.held.summary.particles; });
  for (const auto& name : parameters) {
    add(parameter_head(name),
        [name](const Source& s) { return copy_of(value_at(s.held.summary.parameters, "/" + name)); });
  }
  add("number", [](const Source& s) { return s.held.summary.replicate; });
  if (of_ == RowOf::replicate) {
    add_text("status", [](const Source& s) { return s.held.record.at("status"); });
    add_text("failed_in", [](const Source& s) { return copy_of(value_at(s.held.record, "/failure/where")); });
    add_text("failure", [](const Source& s) { return copy_of(value_at(s.held.record, "/failure/why")); });
  }
  add_text("flags", [](const Source& s) {
    const auto& flags = s.held.record.at("flags");
    return flags.is_null() ? Json(nullptr) : Json(joined_texts(flags));
  });
  add("excluded", [this](const Source& s) { return has_any(s.held.summary, exclude_); });
  add("state", [](const Source& s) { return s.state ? Json(s.index) : Json(nullptr); });
  if (of_ == RowOf::state) add("nearest", [](const Source& s) { return s.index == nearest_of(s.held); });
}

void RecordRows::add_fields(const Fields& fields, Quantity::Of of, std::size_t kinds) {
  // The columns of the head have what a table needs of these.
  constexpr std::array<std::string_view, 7> of_head{"/schema",   "/checksum", "/spec/",        "/status",
                                                    "/failure/", "/nearest",  "/result_digest"};
  const auto all = all_quantities();
  for (const auto& column : columns_of(fields)) {
    auto name = column.name;
    const bool is_quantity = std::any_of(all.begin(), all.end(), [&](const Quantity& quantity) {
      return quantity.of == of && quantity.pointer == column.pointer;
    });
    const bool is_in_head = std::any_of(of_head.begin(), of_head.end(),
                                        [&](const auto start) { return column.pointer.starts_with(start); });
    if (is_quantity || is_in_head || column.field.apart || is_of_more_kinds(column.pointer, kinds)) continue;
    for (const std::string_view object : {"provenance.", "timing."}) {
      if (name.starts_with(object)) name.erase(0, object.size());
    }
    const Json absent = column.field.presence == Presence::if_true ? Json(false) : Json(nullptr);
    const auto value = [of, absent, pointer = column.pointer](const Source& s) {
      const auto* object = of == Quantity::Of::replicate ? &s.held.record : s.state;
      const auto* found = object ? value_at(*object, pointer) : nullptr;
      return found || !object ? copy_of(found) : absent;
    };
    is_text(column.field) ? add_text(name, value) : add(name, value);
  }
}

void RecordRows::add_quantities(const std::vector<Measure>& measures, std::size_t kinds) {
  const auto all = all_quantities();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& quantity = all[k];
    const bool measured =
        !quantity.measure || std::find(measures.begin(), measures.end(), *quantity.measure) != measures.end();
    const bool of_replicate = quantity.of == Quantity::Of::replicate;
    if (!measured || (of_replicate && of_ == RowOf::state) || static_cast<std::size_t>(quantity.kinds) > kinds)
      continue;
    quantities_.push_back(k);
    add(std::string(quantity.name), [of_replicate, pointer = quantity.pointer](const Source& s) {
      if (of_replicate) return copy_of(value_at(s.held.record, pointer));
      return s.state ? copy_of(value_at(*s.state, pointer)) : Json(nullptr);
    });
  }
}

std::string RecordRows::reasons(const Source& source) const {
  Cells cells;
  for (const auto k : quantities_) {
    const auto& quantity = all_quantities()[k];
    const auto* object = quantity.of == Quantity::Of::replicate ? &source.held.record : source.state;
    if (!object) continue;
    const auto* value = value_at(*object, quantity.pointer);
    if (value && !value->is_null()) continue;
    const auto& has = source.held.summary.measures;
    const bool measured = !quantity.measure || std::find(has.begin(), has.end(), *quantity.measure) != has.end();
    const auto& partly = source.held.summary.nearest_only;
    const bool nearest_only =
        !value && quantity.measure && std::find(partly.begin(), partly.end(), *quantity.measure) != partly.end();
    const auto reason = nearest_only ? "only the state nearest jamming was measured"
                        : measured   ? reason_of(*object, quantity.pointer)
                                     : std::string("not measured");
    if (!reason.empty()) cells.push_back(std::string(quantity.name) + ": " + reason);
  }
  return joined(cells, between);
}

std::string RecordRows::line(const Source& source) const {
  std::vector<Json> cells;
  for (const auto& value : values_) cells.push_back(value(source));
  return row_line(format_, columns_, cells);
}

std::string RecordRows::head() const { return head_line(format_, columns_); }

std::string RecordRows::lines(const RecordedReplicate& held) const {
  const bool failed = held.summary.failed;
  if (of_ == RowOf::replicate) {
    if (failed) return line({held, nullptr, 0});
    const auto nearest = nearest_of(held);
    return line({held, &held.record.at("states")[nearest], held.nearest.value_or(nearest)});
  }
  std::string text;
  const auto& states = held.record.at("states");
  for (std::size_t k = 0; k < states.size() && !failed; ++k) text += line({held, &states[k], k});
  return text;
}

}  // namespace isojam
