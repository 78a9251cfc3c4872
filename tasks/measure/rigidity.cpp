#include "engine/rigidity/rigidity.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"
#include "tasks/measure/trough_parts.hpp"

namespace isojam {
namespace {

constexpr QuantityGroup group{
    "rigidity", "Numbers of floppy motions and states of self-stress, from the rank of the rigidity matrix."};

/// One set of constraints, and the quantities that are computed from it.
struct Count {
  std::string_view rows;  ///< name of the set, a key in the record
  Quantity self_stress, floppy;
};
constexpr Count normals{"normals",
                        {"self_stress_normals", "/rigidity/normals/self_stress", group, "1", "s_n"},
                        {"floppy_normals", "/rigidity/normals/floppy", group, "1", "f_n"}};
constexpr Count by_class{"classes",
                         {"self_stress_classes", "/rigidity/classes/self_stress", group, "1", "s_c"},
                         {"floppy_classes", "/rigidity/classes/floppy", group, "1", "f_c"}};
constexpr Count by_trough{"trough",
                          {"self_stress_trough", "/rigidity/trough/self_stress", group, "1", "s_t"},
                          {"floppy_trough", "/rigidity/trough/floppy", group, "1", "f_t"}};
constexpr std::array quantities{normals.self_stress, by_class.self_stress, by_trough.self_stress,
                                normals.floppy,      by_class.floppy,      by_trough.floppy};

void put_rigidity(Json& state, const Count& count, const RigidityMatrix& matrix) {
  const auto rigidity = analyse_rigidity(matrix);
  Json& json = state["rigidity"][std::string(count.rows)];
  json["constraints"] = rigidity.constraints;
  json["rank"] = rigidity.rank;
  put(state, count.self_stress, rigidity.self_stress);
  put(state, count.floppy, rigidity.floppy);
  put_number(json, "tolerance", rigidity.tolerance);
  put_number(json, "least_kept", rigidity.least_kept);
  put_number(json, "largest_dropped", rigidity.largest_dropped);
}

void put_undecided(Json& state, const Count& count, std::string_view why) {
  Json& json = state["rigidity"][std::string(count.rows)];
  put_absent(json, "constraints", why);
  put_absent(json, "rank", why);
  put(state, count.self_stress, std::nullopt, why);
  put(state, count.floppy, std::nullopt, why);
}

/// Both fitted cut-offs are multiplied by these factors, to show how the rank depends on them.
constexpr std::array cutoff_factors{.5, 2.0};

/// Results with scaled cut-offs. Empty for mixtures of several shapes, because each pair of shapes has its own
/// cut-offs.
Json scaled_cutoffs(const Packing& packing, const ClassifiedContacts& classified) {
  Json list = Json::array();
  const ContactAnalysis& analysis = classified.analysis;
  if (!analysis.pairs.empty()) return list;
  for (const double factor : cutoff_factors) {
    const auto classes =
        classify(classified.alignments, factor * analysis.face_face.cutoff, factor * analysis.edge_face.cutoff);
    const auto rigidity =
        analyse_rigidity(class_constraints(packing, classified.contacts, classified.alignments, classes));
    list.push_back({{"factor", factor},
                    {"constraints", rigidity.constraints},
                    {"rank", rigidity.rank},
                    {"self_stress", rigidity.self_stress},
                    {"floppy", rigidity.floppy}});
  }
  return list;
}

/// The constraints of the classes by troughs.
void put_by_trough(Json& state, const Packing& packing, const ClassifiedContacts& classified) {
  const TroughCutoffs cutoffs = trough_cutoffs(histogram_of(classified));
  if (const auto why = undecided(cutoffs)) {
    put_undecided(state, by_trough, *why);
    return;
  }
  const auto classes = classify(classified.alignments, angle_bin_edge(cutoffs.face_face.cutoff),
                                angle_bin_edge(cutoffs.edge_face.cutoff));
  put_rigidity(state, by_trough, class_constraints(packing, classified.contacts, classified.alignments, classes));
}

Measurement measure_rigidity(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const auto classified = classified_contacts(packing, energy);
    Json state;
    put_rigidity(state, normals, normal_constraints(packing, classified.contacts));
    if (const auto why = undecided(classified.analysis)) {
      put_undecided(state, by_class, *why);
      state["rigidity"]["scaled_cutoffs"] = Json::array();
    } else {
      put_rigidity(state, by_class,
                   class_constraints(packing, classified.contacts, classified.alignments, classified.analysis.classes));
      state["rigidity"]["scaled_cutoffs"] = scaled_cutoffs(packing, classified);
    }
    put_by_trough(state, packing, classified);
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::rigidity{.quantities = quantities, .measure = measure_rigidity};

}  // namespace isojam
