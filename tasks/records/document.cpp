#include "tasks/records/document.hpp"

#include "tasks/io/version.hpp"
#include "tasks/measure/rearrangements.hpp"

namespace isojam {
namespace {

/// The fields of all measures. They are collected once, because each state has them.
template <MeasurePart MeasureDefinition::*part>
const Fields& measured_fields() {
  static const Fields all = [] {
    Fields fields;
    for (const Measure measure : all_measures) {
      if (const auto& of = (definition_of(measure).*part).fields)
        for (auto& entry : of().list) fields.list.push_back(std::move(entry));
    }
    return fields;
  }();
  return all;
}

/// Adds fields that are written from JSON. They are not read, because tables take single values from the file's JSON.
/// `fields` must live as long as the program.
void add_json(Fields& field, Json& measured, const Fields& fields) {
  for (const auto& entry : fields.list) {
    Custom value;
    value.write = [&measured, &entry] {
      const auto found = measured.find(entry.key);
      return found == measured.end() ? Json(nullptr) : *found;
    };
    value.read = [](const JsonPlace&) {};
    const auto* const maybe = std::get_if<Maybe>(&entry.member);
    const MemberRef member = maybe ? maybe->example() : entry.member;
    value.fields = std::get<Nested>(member).describe;
    field.custom(entry.key, std::move(value), entry.meaning).optional();
  }
}

void describe_timing(Fields& field, Timing& timing, std::map<std::string, double>& stages) {
  field("wall_seconds", timing.wall_seconds,
        "Wall-clock time of all stages together, including the stages before an interruption.")
      .unit("s")
      .range(not_negative)
      .finite();
  field("cpu_seconds", timing.cpu_seconds,
        "CPU time of the threads that ran the stages, without the other threads that helped with parallel loops.")
      .unit("s")
      .range(not_negative)
      .finite();
  // A description for each stage of each record would take longer than reading their times.
  static const auto names = [] {
    std::vector<std::string_view> list{"jam"};
    for (const Measure measure : all_measures) list.push_back(to_string(measure));
    return list;
  }();
  const auto describe_stages = [](Fields& inner) {
    const Custom time{[] { return Json(nullptr); }, nullptr, {{"type", "number"}, {"minimum", 0}}, "number ≥ 0"};
    for (const auto stage : names) {
      const std::string name(stage);
      const auto meaning = name == "jam" ? "CPU time of the protocol." : "CPU time of the measure `" + name + "`.";
      inner.custom(name, time, meaning).optional().unit("s");
    }
  };
  Custom value{[&stages] { return Json(stages); },
               [&stages](const JsonPlace& place) {
                 place.expect_keys(names);
                 for (const auto& item : place.value().items())
                   place.read(item.key(),
                              [&](const JsonPlace& time) { stages[item.key()] = time.number(not_negative); });
               },
               nullptr, "", describe_stages};
  field.custom("stages", std::move(value), "CPU time of the protocol and of each measure.");
}

/// The specification remains JSON in a record. It is written by to_json(const ReplicateSpec&).
void describe_spec(Fields& field) {
  static ReplicateSpec example;
  const auto add = [&](const char* key, const Json& type, const char* meaning) -> FieldEntry& {
    return field.custom(key, {[] { return Json(nullptr); }, nullptr, {{"type", type}}, type.get<std::string>()},
                        meaning);
  };
  add("solid", "string", "Name of the solid, or of the mixture.");
  add("vertices", "array",
      "Vertices of a user-defined solid, before the solid is scaled to unit volume; absent for a named solid or a "
      "mixture.")
      .optional();
  add("mixture", "array", "Kinds of particles of a mixture; absent if all particles are equal.").optional();
  describe(field, example);
}

}  // namespace

Provenance provenance_of(const ReplicateSpec& spec) {
  Provenance provenance{
      std::string(version()), std::string(git_hash()), std::string(compiler()), spec_digest(spec), {}, {}, {}, {}};
  provenance.protocol = protocol_version, provenance.seed = spec.seed;
  if (spec.start) provenance.start = spec.start->files[static_cast<std::size_t>(spec.replicate)].path;
  return provenance;
}

void describe(Fields& field, Addition& addition) {
  field("measures", addition.measures, "Names of the added measures.");
  field("version", addition.version, "Version of the program that added the measures.");
  field("git", addition.git, "Commit of the sources of the program that added the measures.");
  field("compiler", addition.compiler, "Name and version of the compiler of the program that added the measures.");
  field.nested(
      "before",
      [&addition](Fields& before) {
        before("spec_digest", addition.spec_digest, "Digest of the specification, as in the record.");
        before("result_digest", addition.result_digest, "Digest of the record before the addition.");
      },
      "Digests before this addition. A packing file or path file that the addition did not change still contains "
      "them.");
}

void describe(Fields& field, Provenance& provenance) {
  field("version", provenance.version, "Version of isojam.");
  field(
      "git", provenance.git,
      "Commit of the sources, with `-dirty` at its end if the sources had uncommitted changes. It is `unknown` if the "
      "sources were not in a git repository.");
  field("compiler", provenance.compiler, "Name and version of the compiler.");
  field("spec_digest", provenance.spec_digest,
        "Digest of everything that determines the replicate: `spec` without its measures, and the seed. Two "
        "replicates with the same digest have the same states, whatever else their manifests request.");
  field("protocol", provenance.protocol,
        "Version of the protocol, with which the same specification gives other packings; absent in records of version "
        "1.");
  field("seed", provenance.seed, "Seed of the manifest.");
  field("start", provenance.start,
        "Path of the file with the initial configuration; absent if the initial configuration was random.");
  field("added", provenance.added, "Additions of measures by `isojam measure`, with one object for each addition.");
}

void describe(Fields& field, Failure& failure) {
  field(
      "where", failure.where,
      "Stage that failed. `begin`: the placement of the particles. `jam`: the protocol. Any other value is the name of "
      "the measure that failed.");
  field("why", failure.why, "Reason for the failure.");
}

void describe(Fields& field, RecordedPoint& point) {
  field("phi_j", point.phi_j,
        "Jamming density φ_J: the density at E = 0, from a line that is fitted to φ as a function of (E/N)^(1/6). "
        "Packings with cohesion at zero pressure have none; `phi_0` takes its place.");
  field("standard_error", point.standard_error,
        "Standard error of φ_J in the fit; null if only two states were fitted, or at zero pressure.");
  field(
      "ci95_half_width", point.ci95_half_width,
      "Half width of the 95 % confidence interval of φ_J in the fit (Student t); null if only two states were fitted. "
      "It is not the spread between replicates.");
  field("single_state", point.single_state, "Estimate of φ_J from the state nearest jamming alone: φ − 6E/(dE/dφ).");
  field("exponent", point.exponent,
        "Exponent x of E ∝ Δφ^x in a fit with free x and free φ_J; null with fewer than four fitted states.");
  field("residual", point.residual, "Largest residual of the states to which φ_J was fitted.").range(not_negative);
  field("states", point.states,
        "Indices of the fitted states in the list `states` of the record. The state nearest jamming comes first.");
}

void describe(Fields& field, RecordedCycle& cycle) {
  field("energy_per_particle", cycle.energy_per_particle,
        "Energy per particle E/N of the first state of the decompression.")
      .unit("Y·V_p");
  field("phi_j", cycle.phi_j, "Jamming density of the cycle; null if its decompression has fewer than two states.");
}

void describe(Fields& field, StateRow& row) {
  field.type("state", "One state of the decompression, with the results of all measures for this state.");
  describe(field, row.step, row.delta_phi, StepOf::state);
  field("step", row.index, "Index of this state in the list `path` of the record, counted from 0.");
  add_json(field, row.measured, measured_fields<&MeasureDefinition::state>());
}

void describe(Fields& field, Record& record) {
  field("schema", record.schema, "Name and version of the file format.");
  field("checksum", record.checksum,
        "64-bit FNV-1a checksum of the text of the file. It is computed with zeros in place of the 16 digits of this "
        "field.");
  field("provenance", record.provenance, "The build of isojam, the manifest and the seed that produced the record.");
  field.custom("spec",
               {[&record] { return record.spec; }, [&record](const JsonPlace& place) { record.spec = place.value(); },
                nullptr, "", describe_spec},
               "Settings of the replicate.");
  field("status", record.status,
        "Result of the replicate. `done`: φ_J and all requested measures were computed. `failed`: φ_J or a requested "
        "measure could not be computed.");
  field("failure", record.failure, "Stage and reason of the failure; absent if the replicate did not fail.");
  field("flags", record.flags,
        "Flags of the replicate; docs/results.md defines each flag. Null if the replicate failed.");
  field.nested(
      "timing", [&record](Fields& inner) { describe_timing(inner, record.timing, record.stage_seconds); },
      "Time that the replicate took. `result_digest` does not depend on it.");
  field("evaluations", record.evaluations,
        "Number of evaluations of energy and forces in all minimisations of the protocol.");
  field("pairs", record.pairs,
        "Numbers of pairs of particles, by the way in which they were processed, summed over all evaluations of energy "
        "and forces.");
  field("work", record.work, "Numbers of operations of the minimisers, summed over all strain steps.");
  field("phi_0", record.phi_0,
        "Density φ_0 at zero pressure. Only packings with cohesion at zero pressure have this field.")
      .range({0, not_negative.high, true});
  field("phi_j", record.phi_j, "Jamming density, and the fit that gives it. Null if the replicate failed.");
  field("nearest", record.nearest,
        "Index in `states` of the state nearest jamming. Its packing is in a file of `packings/`, which has the same "
        "name as the file of this record. Null if the replicate failed.");
  static const Fields rearrangements = fields_of<RearrangementPart>();
  add_json(field, record.measured, measured_fields<&MeasureDefinition::replicate>());
  add_json(field, record.measured, rearrangements);
  field("nearest_only", record.nearest_only,
        "Measures that were computed only for the state nearest jamming, because `isojam measure` added them and the "
        "path was not kept. The other states lack their values. Absent if there are none.");
  field("cycles", record.cycles, "Training cycles in their order; absent if there are none.");
  field("states", record.states,
        "States of the last solution branch of the decompression, in the order in which they were computed.");
  field("path", record.path,
        "All strain steps of the compression and the decompression, each with the state after its minimisation.");
  field(
      "result_digest", record.result_digest,
      "Digest of the record without `checksum`, `provenance` and `timing`. Two runs of the same replicate by the same "
      "build give the same digest.");
}

}  // namespace isojam
