#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tasks/manifest/base.hpp"
#include "tasks/manifest/by_solid.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/packings/mixture_json.hpp"

namespace isojam {

namespace {

constexpr std::size_t longest_name = 64;
constexpr std::string_view name_pattern = "^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$";

bool is_safe(std::string_view name) {
  const auto alphanumeric = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !name.empty() && name.size() <= longest_name && alphanumeric(name[0]) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return alphanumeric(c) || c == '.' || c == '_' || c == '-'; });
}

std::string read_name(const JsonPlace& place) {
  const auto allowed =
      fmt::format("1 to {} letters, digits, '.', '_' and '-', the first a letter or digit", longest_name);
  auto name = place.text(allowed);
  if (!is_safe(name)) place.refuse("the name cannot be used as the name of a directory", allowed);
  return name;
}

/// A text that a manifest may have, but that does not belong to the study.
Custom unused_text(Json schema) {
  schema["type"] = "string";
  return {[] { return Json(); }, [](const JsonPlace& place) { place.text(); }, std::move(schema), "text"};
}

// ---- The sweep ------------------------------------------------------------------------------------------------------
void read_solids(const JsonPlace& list, Manifest& manifest) {
  const auto count = list.expect_list("a list, each entry the name of a solid or a mixture");
  if (count == 0) list.refuse("the list is empty", "one or more names of solids or mixtures");
  auto& solids = manifest.solids;
  solids.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const auto entry = list.at(k);
    list.attempt([&] {
      auto mixture = read_sweep_entry(entry, manifest.definitions);
      if (!entry.is_sound()) return;
      if (std::find(solids.begin(), solids.end(), mixture) != solids.end())
        entry.refuse_with_remedy(fmt::format("{} is given twice", compact(entry.value())), "give each value once");
      const auto has_name = [&](const Mixture& other) { return to_string(other) == to_string(mixture); };
      if (std::any_of(solids.begin(), solids.end(), has_name))
        list.refuse_with_remedy(fmt::format("two entries have the name {}", to_string(mixture)),
                                "give them different names");
      solids.push_back(std::move(mixture));
    });
  }
  std::sort(solids.begin(), solids.end());
}

Json solids_json(const Manifest& manifest) {
  Json list = Json::array();
  std::transform(manifest.solids.begin(), manifest.solids.end(), std::back_inserter(list), sweep_entry);
  return list;
}

/// A list of values of each parameter.
void swept_fields(Fields& fields, Manifest& manifest) {
  auto& swept = manifest.swept;
  for (const auto& parameter : all_parameters()) {
    auto& field = fields.list.emplace_back(parameter.field);
    const std::string name = parameter.name;
    field.key = name;
    auto path = parameter.pointer.substr(1);
    std::replace(path.begin(), path.end(), '/', '.');
    field.meaning = fmt::format("Values of `{}`.", path);
    field.member = Many{[&swept, name] {
                          const auto found = swept.find(name);
                          return found == swept.end() ? 0 : found->second.size();
                        },
                        [&swept, name](std::size_t size) { swept[name].resize(size); },
                        [&swept, name](std::size_t k) { return parameter_of(swept.at(name)[k], name).field.member; },
                        [member = parameter.field.member] { return member; }};
    field.length(1).distinct().if_any();
  }
}

void describe_sweep(Fields& field, Manifest& manifest) {
  const Json solids{{"type", "array"}, {"items", sweep_entry_schema()}, {"minItems", 1}, {"uniqueItems", true}};
  field.custom("solid",
               {[&] { return solids_json(manifest); }, [&](const JsonPlace& list) { read_solids(list, manifest); },
                solids, "list of names of solids, or of mixtures"},
               "Convex solids, scaled to unit volume, and mixtures.");
  field("particles", manifest.particles,
        "Number N of particles in the periodic cell. The smallest allowed number depends on the solid and on "
        "`max_density`.")
      .range({1, 100000})
      .length(1)
      .distinct();
  swept_fields(field, manifest);
  add_former_keys(field);
}

// ---- Replicates -----------------------------------------------------------------------------------------------------
Fields rule_fields(Replicates& replicates, Goal& goal) {
  constexpr Range at_least_two{2, most_replicates};  // one replicate has no confidence interval
  Fields field;
  field("min", replicates.min,
        "Number of replicates after which isojam checks the confidence interval for the first time. If it is too wide, "
        "isojam adds a quarter of the present number of replicates, but at least two, and checks again. With a `min` "
        "below 8, the rule may request many more replicates than necessary.")
      .range(at_least_two);
  field("max", replicates.max, "Largest number of replicates. It must be at least `min`.").range(at_least_two);
  static const auto names = [] {
    std::vector<std::string_view> list;
    for (const auto& quantity : all_quantities()) list.push_back(quantity.name);
    return list;
  }();
  field.custom("quantity",
               {[&goal] { return Json(goal.quantity); },
                [&goal](const JsonPlace& place) { goal.quantity = names[place.choice(names)]; },
                {{"enum", names}},
                "name of a column of the tables"},
               "Quantity whose confidence interval is checked: the name of a column of the tables, such as `phi_j`, "
               "`Z` or `C`.");
  field("half_width", goal.half_width,
        "Requested half width of the 95 % confidence interval, in the unit of the quantity. When the half width is at "
        "most this value, isojam adds no more replicates.")
      .range({0, 1e6, true})
      .finite();
  return field;
}

void read_replicates(const JsonPlace& place, Replicates& replicates) {
  constexpr Range range{1, most_replicates};
  if (place.value().is_object()) {
    read_into(place, rule_fields(replicates, replicates.goal.emplace()));
  } else if (place.value().is_number()) {
    replicates.min = replicates.max = static_cast<int>(place.integer(range));
  } else {
    place.not_accepted(fmt::format("{}, or {{\"min\", \"max\", \"quantity\", \"half_width\"}}", integer_in(range)));
  }
}

Custom replicates_field(Replicates& replicates) {
  Replicates example;
  Goal goal;
  const auto number = Json{{"type", "integer"}, {"minimum", 1}, {"maximum", static_cast<int>(most_replicates)}};
  return {[&replicates]() -> Json {
            if (!replicates.goal) return replicates.max;
            return written(rule_fields(replicates, *replicates.goal));
          },
          [&replicates](const JsonPlace& place) { read_replicates(place, replicates); },
          {{"oneOf", {number, object_schema(rule_fields(example, goal))}}},
          "integer > 0, or `{\"min\", \"max\", \"quantity\", \"half_width\"}`"};
}

// ---- Other objects --------------------------------------------------------------------------------------------------
/// Lets the errors for parameters in the wrong object name the right one.
void add_places(Fields& fields) {
  for (const auto& parameter : all_parameters()) {
    const auto is_here = [&](const FieldEntry& field) { return field.key == parameter.name; };
    if (std::none_of(fields.list.begin(), fields.list.end(), is_here))
      fields.renamed.emplace_back(parameter.name, parameter.pointer);
  }
  add_former_keys(fields);
}

Custom definitions_field(Manifest& manifest) {
  const auto write = [&manifest] { return definitions_json(manifest.solids, manifest.definitions); };
  return {write, [&manifest](const JsonPlace& place) { manifest.definitions = read_definitions(place); },
          definitions_schema(), "object of names and definitions"};
}

Custom base_field(Json& base) {
  JamOptions example;
  auto schema = object_schema(flat_fields(example));
  schema["minProperties"] = 1;
  return {[&base] { return base.empty() ? Json() : base; },
          [&base](const JsonPlace& place) { base = read_base(place); }, std::move(schema),
          "object of swept parameters and their values"};
}

/// Keys for how packings are minimised, measured and kept.
void describe_results(Fields& field, Manifest& manifest) {
  const auto minimiser = [&](Fields& of) {
    minimiser_fields(of, manifest.protocol);
    add_places(of);
  };
  field
      .nested("minimiser", minimiser,
              "Method that brings each state of the decompression to equilibrium, and its stopping criteria.")
      .optional();
  field("measure", manifest.measures, "Measures to compute for the states of the decompression, in addition to φ_J.")
      .distinct()
      .optional();
  field("modes", manifest.measuring.modes, "Number of vibrational modes to compute at each end of the spectrum.")
      .range({1, 1000})
      .optional();
  field("shear", manifest.measuring.shear,
        "Quasi-static shear of the state nearest jamming. Only the measure `shear` uses this key.")
      .optional();
  field("exponents_of_all_states", manifest.measuring.exponents_of_all_states,
        "If true, the measure `exponents` measures all states of the decompression. If false, it measures only the "
        "state nearest jamming.")
      .optional();
  field("keep_path", manifest.keep_path,
        "If true, isojam saves the packings of all states of each decompression. If false, it saves only the states "
        "nearest jamming. You can change this key later in the same results directory.")
      .optional();
  field("exclude", manifest.exclude,
        "Flags that exclude a replicate. Excluded replicates are left out of the means, and the stopping rule ignores "
        "them. If replicates are excluded, the tables also contain the means over all replicates. You can change this "
        "key later in the same results directory.")
      .distinct()
      .optional();
  field
      .custom("base", base_field(manifest.base),
              "Values of swept parameters that select the base rows. For every row that is not a base row, the tables "
              "then list the paired differences between this row and its base row: the row that has the values in "
              "`base` and is otherwise the same. You can change this key later in the same results directory.")
      .optional();
  field("start", manifest.start,
        "Initial configurations from files, instead of random ones. Replicate k starts from file k of the list, "
        "counted from 0. If this key is present, `sweep.solid` and `sweep.particles` must have one entry each, which "
        "agree with the files.");
}

}  // namespace

std::vector<Measure> usual_measures() {
  std::vector<Measure> list;
  std::copy_if(all_measures.begin(), all_measures.end(), std::back_inserter(list),
               [](Measure measure) { return definition_of(measure).by_default; });
  return list;
}

void describe(Fields& field, Manifest& manifest) {
  field.type("",
             "A study: replicates for every combination of the swept values. Units: Young's modulus Y = 1, mean "
             "particle volume V_p = 1, mass density ρ = 1.");
  field
      .custom("$schema", unused_text(Json::object()),
              "Path or address of this schema. Editors use it to check the manifest.")
      .optional();
  field.custom("name",
               {[&] { return Json(manifest.name); },
                [&](const JsonPlace& place) { manifest.name = read_name(place); },
                {{"type", "string"}, {"pattern", name_pattern}},
                "text"},
               "Name of the study. By default, it is also the name of the results directory.");
  field
      .custom("checksum", unused_text({{"pattern", "^[0-9a-f]{16}$"}}),
              "64-bit FNV-1a checksum of the text of the file. It is computed with zeros in place of the 16 digits of "
              "this field. Only the copy of the manifest in a results directory has this key. Leave it out of your own "
              "manifest.")
      .optional();
  // 2^53: every JSON reader represents smaller integers exactly.
  field("seed", manifest.seed,
        "Seed of the random numbers. They depend only on the seed, the solid, the number of particles and the number "
        "of the replicate. Replicates with the same number therefore use the same random numbers at every swept value "
        "of the parameters of `protocol` and `minimiser`.")
      .range(count_range);
  field
      .custom("solids", definitions_field(manifest),
              "User-defined solids by name. You can use these names in `sweep.solid`. Each solid is a box, a list of "
              "vertices, or an OFF, STL or OBJ file. isojam scales every solid to unit volume.")
      .optional();
  field.nested(
      "sweep", [&](Fields& of) { describe_sweep(of, manifest); },
      "Lists of values. Every combination of these values is one sweep point. Keys of `protocol` and "
      "`minimiser` can be swept too.");
  field.custom("replicates", replicates_field(manifest.replicates),
               "Number of independent packings at each sweep point, or a stopping rule. With a stopping rule, isojam "
               "adds replicates until the 95 % confidence interval of the mean of a quantity is narrow enough. For a "
               "mean, the interval uses the standard deviation of the first `min` replicates (Stein's method). For a "
               "proportion, it is Wilson's interval.");
  const auto protocol = [&](Fields& of) {
    protocol_fields(of, manifest.protocol);
    of.custom("by_solid", by_solid_field(manifest),
              "Parameters of `protocol` that have other values for some solids, by the name of the solid in "
              "`sweep.solid`: `{\"cube\": {\"max_density\": 1.1}}`. You can change the values of a solid later in the "
              "same results directory, as long as all its recorded replicates have failed; they are then computed "
              "again.")
        .optional();
    add_places(of);
  };
  field.nested("protocol", protocol, "Parameters of compression and decompression.").optional();
  describe_results(field, manifest);
  add_places(field);
}

SweptValues swept_values(const Manifest& manifest) {
  SweptValues all;
  for (const auto& [name, values] : manifest.swept) {
    for (const auto& options : values) all[name].push_back(value_of(name, options));
  }
  return all;
}

void sort_lists(Manifest& manifest) {
  std::sort(manifest.particles.begin(), manifest.particles.end());
  std::sort(manifest.measures.begin(), manifest.measures.end());
  std::sort(manifest.exclude.begin(), manifest.exclude.end());
  for (auto& [name, values] : manifest.swept) {
    std::vector<std::pair<Json, JamOptions>> pairs;
    for (const auto& options : values) pairs.emplace_back(value_of(name, options), options);
    std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::transform(pairs.begin(), pairs.end(), values.begin(), [](const auto& pair) { return pair.second; });
  }
}

}  // namespace isojam
