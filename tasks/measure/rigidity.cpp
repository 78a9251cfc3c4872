#include "engine/rigidity/rigidity.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

Json rigidity_record(const RigidityMatrix& matrix) {
  const auto rigidity = analyse_rigidity(matrix);
  Json json;
  json["constraints"] = rigidity.constraints;
  json["rank"] = rigidity.rank;
  json["self_stress"] = rigidity.self_stress;
  json["floppy"] = rigidity.floppy;
  put_number(json, "tolerance", rigidity.tolerance);
  put_number(json, "least_kept", rigidity.least_kept);
  put_number(json, "largest_dropped", rigidity.largest_dropped);
  return json;
}

Json undecided_record(std::string_view why) {
  Json json;
  for (const auto* key : {"constraints", "rank", "self_stress", "floppy"}) put_absent(json, key, why);
  return json;
}

}  // namespace

Measurement measure_rigidity(const JamResult& jam) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const auto classified = classified_contacts(packing, energy);
    Json json;
    json["normals"] = rigidity_record(normal_constraints(packing, classified.contacts));
    const auto why = undecided(classified.analysis);
    json["classes"] = why ? undecided_record(*why)
                          : rigidity_record(class_constraints(packing, classified.contacts, classified.alignments,
                                                              classified.analysis.classes));
    measurement.states.push_back({{"rigidity", std::move(json)}});
  }
  return measurement;
}

}  // namespace isojam
