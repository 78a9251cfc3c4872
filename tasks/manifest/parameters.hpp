#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/shear/shear.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/io/fields.hpp"

namespace isojam {

// The parameters of the engine that a manifest may set or sweep: the fields of `protocol` and of `minimiser`. Their
// default values are those of JamOptions.

void protocol_fields(Fields& field, JamOptions& options);
void minimiser_fields(Fields& field, JamOptions& options);
/// Both as objects.
void describe(Fields& field, JamOptions& options);
/// The fields of `shear`, the settings of this measure.
void describe(Fields& field, ShearOptions& shear);

/// A parameter of some options. No two have the same name. For a parameter in an object of its group, the name is the
/// path with a dot, such as cohesion.range. The keys of `sweep` and `base` are the names.
using Parameter = FlatColumn;
std::vector<Parameter> parameters_of(JamOptions& options);

/// The parameters with their default values: first those of the protocol, then those of the minimiser.
const std::vector<Parameter>& all_parameters();
/// nullptr if there is none with this name.
const Parameter* find_parameter(std::string_view name);
Parameter parameter_of(JamOptions& options, std::string_view name);
Json value_of(std::string_view name, const JamOptions& options);

/// Values of some parameters.
struct OptionSet {
  Json parameters = Json::object();  ///< the values by name
  JamOptions options;                ///< has these values
};
/// Copies the values of these parameters.
void copy_values(const OptionSet& from, JamOptions& to);

/// The parameters without their objects. Their keys are their names.
Fields flat_fields(JamOptions& options);
/// Reads those of the fields that the object has. The fields refer to set.options.
void read_some(const JsonPlace& place, const Fields& fields, OptionSet& set);
/// Lets the errors for keys of earlier versions say what to use instead.
void add_former_keys(Fields& fields);

/// The place at a JSON pointer of the manifest; nullopt if there is none.
std::optional<JsonPlace> place_at(const JsonPlace& root, std::string_view pointer);
/// The place of an entry of a list; the list itself if it has no such entry.
JsonPlace place_of_entry(const JsonPlace& list, const Json& entry);
/// The place that determines a parameter: its list in `sweep`, its value for this solid, its value in its group, or the
/// whole manifest.
JsonPlace place_of(const JsonPlace& root, std::string_view name, std::string_view solid = "");

}  // namespace isojam
