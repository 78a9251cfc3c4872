#include "tasks/manifest/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace isojam {
namespace {

constexpr Range positive_to(double high) { return {0, high, true, false}; }

/// Methods that a manifest may choose. The engine has others for comparison (`isojam chart`).
constexpr std::array methods{Method::multipliers, Method::newton, Method::lbfgs};

void compression_fields(Fields& field, Compression& c) {
  field("initial_density", c.initial_density, "Density φ of the random initial configuration.").range(positive_to(1));
  field("compression_step", c.step,
        "Increase of the density φ in one compression step. The last steps are shorter, so that they end near "
        "`target_energy`. If no value is given, tetrahedra have 0.02.")
      .range(positive_to(1));
  field("target_energy", c.target_energy, "Energy per particle E/N (Y·V_p) at which compression ends.")
      .range(positive_to(1));
  field("target_before_relaxation", c.target_before_relaxation,
        "Meaning of `target_energy`. `false`: Compression ends at the first relaxed state whose E/N is at least "
        "`target_energy`. `true`: Each compression step is halved, at most six times, until E/N before the relaxation "
        "is at most `target_energy`. Compression ends at the first state that is still jammed after its relaxation.");
  field("max_density", c.max_density,
        "Largest density φ that compression may reach. The cell must be so large that no particle can touch two "
        "images of another particle up to this density. Cubes become ordered during compression, so their default is "
        "1.07, or more if `target_energy` is higher. In a cell that is too small for that density, it is the largest "
        "possible one, but at least 0.93.")
      .range(positive_to(2));
  field("compression_evaluations", c.evaluations,
        "Largest number of evaluations of L-BFGS for one compression state. After this number, isojam makes the next "
        "compression step. If no value is given, tetrahedra have 2000 evaluations.")
      .range({1, 1e9});
}

void decompression_fields(Fields& field, Decompression& d) {
  field("step_fraction", d.step_fraction,
        "Length of a decompression step, as a fraction of Δφ, which isojam estimates from the last state.")
      .range({0, 1, true, true});
  field("longest_step", d.longest_step, "Largest decrease of φ in one decompression step.").range(positive_to(1));
  field("final_distance", d.final_distance,
        "Decompression ends when the estimated distance to jamming Δφ is at most this value.")
      .range(positive_to(1));
  field("fit_window", d.fit_window, "φ_J is fitted to the states whose distance to jamming Δφ is below this value.")
      .range(positive_to(1));
  field("control", d.control,
        "Prescribed quantity of the states of the decompression. `density`: The density φ is prescribed. `pressure`: "
        "The pressure is prescribed, and the volume of the cell relaxes. A step that would reduce Δφ by a fraction f "
        "multiplies the pressure by (1 − f)^5.");
}

void cohesion_fields(Fields& field, JamOptions& o) {
  field("strength", o.cohesion.strength,
        "Strength of the cohesion, in units of Young's modulus Y. With 0 there is no cohesion. From about 0.001 on, it "
        "presses the particles into each other.")
      .range({0, 1});
  field("range", o.cohesion.range,
        "Range of the cohesion, in units of V_p^(1/3): particles attract each other if their distance is smaller than "
        "this length.")
      .range(positive_to(1));
  field("until", o.cohesion_until,
        "Stage until which cohesion acts. `decompression`: It acts only during compression. `end`: It always acts. "
        "Instead of a decompression, Newton's method relaxes the packing and its cell to zero pressure, and the "
        "density φ_0 of this state takes the place of φ_J.");
}

/// Every parameter can be left out, and none is infinite.
void make_optional(Fields& fields) {
  for (auto& entry : fields.list) entry.optional().finite();
}

/// Index of a parameter in the list of any options.
std::size_t index_of(std::string_view name) {
  return static_cast<std::size_t>(find_parameter(name) - all_parameters().data());
}

/// Options to which others are copied, because it takes long to list parameters.
struct Listed {
  JamOptions options{};
  std::vector<Parameter> parameters = parameters_of(options);
};

}  // namespace

void protocol_fields(Fields& field, JamOptions& options) {
  compression_fields(field, options.compression);
  decompression_fields(field, options.decompression);
  field("max_steps", options.max_steps, "Largest number of strain steps in compression and decompression together.")
      .range({1, 1e6});
  field("cell", options.cell,
        "Shape of the cell. `isotropic`: The cell is a cube. `free`: The cell shape relaxes in compression and "
        "decompression, so that every state has hydrostatic stress.");
  const auto cohesion = [&options](Fields& of) {
    cohesion_fields(of, options);
    make_optional(of);
  };
  field.nested("cohesion", cohesion,
               "Cohesion: a short-ranged attraction between the particles. Each pair of particles has the additional "
               "energy −`strength`·V_h, where V_h is the overlap volume of the two solids after all their faces have "
               "moved outwards by `range`/2. Without this key there is no cohesion. Sweep its keys under the names "
               "`cohesion.strength`, `cohesion.range` and `cohesion.until`.");
  field("cycles", options.cycles,
        "Number of training cycles. In each cycle, the packing is decompressed to `final_distance` and compressed "
        "again, before the decompression that gives φ_J.")
      .range({0, 1000});
  make_optional(field);
}

void minimiser_fields(Fields& field, JamOptions& options) {
  auto& m = options.minimise;
  field.member("method", kinds::among<methods>(m.method),
               "Method that finds the equilibria. `multipliers`: the method of multipliers follows the equilibrium "
               "through the strain steps. Newton's method finds the first equilibrium, unless compression ended far "
               "from equilibrium. With any other value, the named method finds all equilibria.");
  field("residual", m.residual,
        "Residual at which a minimisation ends. The residual is the largest net force on a particle, or the largest "
        "net torque divided by R, whichever is greater, divided by the mean contact force. R is the radius of gyration "
        "of the particle.")
      .range(positive_to(1));
  field("energy_change", m.energy_change,
        "A minimisation also ends if an iteration changes the energy by less than this fraction. The value 0 switches "
        "this criterion off.")
      .range({0, 1});
  field("max_evaluations", m.max_evaluations,
        "Largest number of evaluations of energy and forces in one minimisation of the decompression.")
      .range({1, 1e9});
  make_optional(field);
}

void describe(Fields& field, ShearOptions& shear) {
  // Strains of 0.01 are already large near jamming. Stresses are fractions of the pressure.
  constexpr Range load_range{0, 1, true};
  field("mode", shear.mode,
        "Kind of shear. `pure`: The cell is stretched along x and compressed along y. `simple`: Points move along x in "
        "proportion to y.");
  field("control", shear.control,
        "Prescribed quantity. `strain`: The shear strain γ is prescribed, at constant volume. `stress`: The shear "
        "stress s is prescribed, at constant pressure, and the cell shape relaxes.");
  field("step", shear.step,
        "Length of a shear step: the change of γ, or, if the stress is prescribed, the change of s divided by the "
        "initial pressure.")
      .range(load_range);
  field("until", shear.until,
        "Final value of γ, or, if the stress is prescribed, of s divided by the initial pressure. It must be at least "
        "`step`, and at most 10000 times `step`.")
      .range(load_range);
  field("back", shear.back,
        "If true, the prescribed γ or s is reduced to zero again, step by step, after it has reached its final value.");
  make_optional(field);
}

void describe(Fields& field, JamOptions& options) {
  for (const auto& [key, fields_of] : {std::pair("protocol", &protocol_fields), {"minimiser", &minimiser_fields}}) {
    field.nested(
        key, [&options, of = fields_of](Fields& inner) { of(inner, options); },
        fmt::format("All keys of `{}` in the manifest. Keys that the manifest leaves out have their default "
                    "values.",
                    key));
  }
}

std::vector<Parameter> parameters_of(JamOptions& options) {
  Fields fields;
  describe(fields, options);
  auto list = columns_of(fields);
  for (auto& parameter : list) parameter.name.erase(0, parameter.name.find('.') + 1);
  return list;
}

const std::vector<Parameter>& all_parameters() {
  static JamOptions usual;
  static const auto list = parameters_of(usual);
  return list;
}

const Parameter* find_parameter(std::string_view name) {
  const auto& all = all_parameters();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Parameter& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Parameter parameter_of(JamOptions& options, std::string_view name) { return parameters_of(options)[index_of(name)]; }

Json value_of(std::string_view name, const JamOptions& options) {
  thread_local Listed listed;
  listed.options = options;
  return written(listed.parameters[index_of(name)].field);
}

void copy_values(const OptionSet& from, JamOptions& to) {
  thread_local Listed source, target;
  source.options = from.options;
  target.options = to;
  for (const auto& item : from.parameters.items()) {
    const auto k = index_of(item.key());
    copy_value(source.parameters[k].field.member, target.parameters[k].field.member);
  }
  to = target.options;
}

Fields flat_fields(JamOptions& options) {
  Fields fields;
  for (auto& parameter : parameters_of(options)) {
    parameter.field.key = parameter.name;
    fields.list.push_back(std::move(parameter.field));
  }
  add_former_keys(fields);
  return fields;
}

void read_some(const JsonPlace& place, const Fields& fields, OptionSet& set) {
  read_into(place, fields);
  for (const auto& field : fields.list) {
    if (place.has(field.key)) set.parameters[field.key] = written(field);
  }
}

void add_former_keys(Fields& fields) {
  fields.renamed.emplace_back("consolidation_step", "compression_step");
  fields.renamed.emplace_back("consolidation_evaluations", "compression_evaluations");
  const std::string is_fixed = "delete it; its default is now the only value";
  fields.removed = {
      {"consolidation", "use \"compression_evaluations\": 50 in place of \"hasty\", and delete \"relaxed\""},
      {"consolidation_residual", "use \"compression_evaluations\" to limit the relaxation"},
      {"event_resolution", "use a smaller \"step_fraction\""},
      {"consolidation_energy", is_fixed},
      {"unjammed_energy", is_fixed},
      {"history", is_fixed}};
}

std::optional<JsonPlace> place_at(const JsonPlace& root, std::string_view pointer) {
  // Names of parameters and solids have no letters that a pointer escapes.
  const auto end = std::min(pointer.find('/', 1), pointer.size());
  const std::string key(pointer.substr(1, end - 1));
  if (!root.has(key)) return std::nullopt;
  if (end == pointer.size()) return root.at(key);
  return place_at(root.at(key), pointer.substr(end));
}

JsonPlace place_of_entry(const JsonPlace& list, const Json& entry) {
  const auto& value = list.value();
  const auto found = std::find(value.begin(), value.end(), entry);
  return found == value.end() ? list : list.at(static_cast<std::size_t>(found - value.begin()));
}

JsonPlace place_of(const JsonPlace& root, std::string_view name, std::string_view solid) {
  const std::string of_solid = "/protocol/by_solid/" + std::string(solid) + "/" + std::string(name);
  for (const auto& pointer : {"/sweep/" + std::string(name), of_solid, find_parameter(name)->pointer}) {
    if (const auto place = place_at(root, pointer)) return *place;
  }
  return root;
}

}  // namespace isojam
