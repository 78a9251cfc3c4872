#include "engine/rigidity/contact_patch.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

// The states of self-stress that contacts can bear which only push: faces at the corners of a polygon, edges at two
// ends.

constexpr std::string_view group = "one-sided forces";
constexpr Quantity dimension{"one_sided_dimension", "/one_sided/dimension", group, "1", "d_+"};
constexpr Quantity least_margin{"least_margin", "/one_sided/least_margin", group, "1", "\\min\\mu"};
constexpr Quantity median_margin{"median_margin", "/one_sided/median_margin", group, "1", "\\tilde\\mu"};
constexpr std::array quantities{dimension, least_margin, median_margin};

constexpr std::string_view acts_outside = "the force of a contact acts outside its patch";

Json one_sided_record(const Packing& packing, PackingEnergy& energy) {
  const auto classified = classified_contacts(packing, energy);
  Json state;
  if (const auto why = undecided(classified.analysis)) {
    for (const auto& quantity : quantities) put(state, quantity, std::nullopt, *why);
    put_absent(state["one_sided"], "constraints", *why);
    put_absent(state["one_sided"], "outside", *why);
    put_absent(state["one_sided"], "outside_faces", *why);
    return state;
  }
  const auto forces = contact_forces(packing, classified.contacts);
  const auto stresses =
      one_sided_stresses(packing, classified.contacts, forces, classified.alignments, classified.analysis.classes);
  put(state, dimension, stresses.outside == 0 ? std::optional<double>(stresses.dimension) : std::nullopt, acts_outside);
  put(state, least_margin, stresses.least_margin);
  put(state, median_margin, stresses.median_margin);
  state["one_sided"]["constraints"] = stresses.constraints;
  state["one_sided"]["outside"] = stresses.outside;
  state["one_sided"]["outside_faces"] = stresses.outside_faces;
  return state;
}

Measurement measure_one_sided(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) measurement.states.push_back(one_sided_record(packing, energy));
  return measurement;
}

}  // namespace

const MeasureDefinition measures::one_sided{.quantities = quantities, .measure = measure_one_sided};

}  // namespace isojam
