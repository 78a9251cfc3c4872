#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/analysis/cohesive_contacts.hpp"
#include "engine/analysis/order.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/shared_parts.hpp"
#include "tasks/measure/trough_parts.hpp"

namespace isojam {
namespace {

constexpr std::string_view per_particle = "per particle";
constexpr Quantity Z{"Z", "/contacts/Z", main_group, per_particle, "Z"};
constexpr Quantity Z_ff{"Z_ff", "/contacts/Z_ff", main_group, per_particle, "Z_{ff}"};
constexpr Quantity Z_ef{"Z_ef", "/contacts/Z_ef", main_group, per_particle, "Z_{ef}"};
constexpr Quantity Z_l{"Z_l", "/contacts/Z_l", main_group, per_particle, "Z_l"};
constexpr Quantity C{"C", "/contacts/C", main_group, per_particle, "C"};
constexpr Quantity Z_ff_gap{"Z_ff_gap", "/contacts/Z_ff_gap", contact_group, per_particle, "Z_{ff}^{gap}"};
constexpr Quantity Z_ff_fixed{"Z_ff_fixed", "/contacts/fixed_cutoffs/Z_ff", contact_group, per_particle,
                              "Z_{ff}^{fixed}"};
constexpr Quantity Z_ef_fixed{"Z_ef_fixed", "/contacts/fixed_cutoffs/Z_ef", contact_group, per_particle,
                              "Z_{ef}^{fixed}"};
constexpr Quantity Z_l_fixed{"Z_l_fixed", "/contacts/fixed_cutoffs/Z_l", contact_group, per_particle, "Z_l^{fixed}"};
constexpr Quantity C_fixed{"C_fixed", "/contacts/fixed_cutoffs/C", contact_group, per_particle, "C^{fixed}"};
constexpr QuantityGroup kind_group{"kinds of a mixture", "Contact numbers of the particles of each kind."};
constexpr Quantity Z_1 = of_mixture({"Z_1", "/contacts/kind_1/Z", kind_group, per_particle, "Z_1"}, 2);
constexpr Quantity Z_2 = of_mixture({"Z_2", "/contacts/kind_2/Z", kind_group, per_particle, "Z_2"}, 2);
constexpr Quantity Z_3 = of_mixture({"Z_3", "/contacts/kind_3/Z", kind_group, per_particle, "Z_3"}, 3);
constexpr Quantity Z_4 = of_mixture({"Z_4", "/contacts/kind_4/Z", kind_group, per_particle, "Z_4"}, 4);
constexpr Quantity partial(std::string_view name, std::string_view pointer, std::string_view latex, int kinds) {
  return of_mixture({name, pointer, kind_group, per_particle, latex}, kinds);
}
constexpr Quantity Z_11 = partial("Z_11", "/contacts/partial/Z_1_1", "Z_{11}", 2);
constexpr Quantity Z_12 = partial("Z_12", "/contacts/partial/Z_1_2", "Z_{12}", 2);
constexpr Quantity Z_13 = partial("Z_13", "/contacts/partial/Z_1_3", "Z_{13}", 3);
constexpr Quantity Z_14 = partial("Z_14", "/contacts/partial/Z_1_4", "Z_{14}", 4);
constexpr Quantity Z_21 = partial("Z_21", "/contacts/partial/Z_2_1", "Z_{21}", 2);
constexpr Quantity Z_22 = partial("Z_22", "/contacts/partial/Z_2_2", "Z_{22}", 2);
constexpr Quantity Z_23 = partial("Z_23", "/contacts/partial/Z_2_3", "Z_{23}", 3);
constexpr Quantity Z_24 = partial("Z_24", "/contacts/partial/Z_2_4", "Z_{24}", 4);
constexpr Quantity Z_31 = partial("Z_31", "/contacts/partial/Z_3_1", "Z_{31}", 3);
constexpr Quantity Z_32 = partial("Z_32", "/contacts/partial/Z_3_2", "Z_{32}", 3);
constexpr Quantity Z_33 = partial("Z_33", "/contacts/partial/Z_3_3", "Z_{33}", 3);
constexpr Quantity Z_34 = partial("Z_34", "/contacts/partial/Z_3_4", "Z_{34}", 4);
constexpr Quantity Z_41 = partial("Z_41", "/contacts/partial/Z_4_1", "Z_{41}", 4);
constexpr Quantity Z_42 = partial("Z_42", "/contacts/partial/Z_4_2", "Z_{42}", 4);
constexpr Quantity Z_43 = partial("Z_43", "/contacts/partial/Z_4_3", "Z_{43}", 4);
constexpr Quantity Z_44 = partial("Z_44", "/contacts/partial/Z_4_4", "Z_{44}", 4);
constexpr QuantityGroup cohesion_group{"cohesion", "Contacts of the packing with cohesion at zero pressure."};
constexpr Quantity Z_grown = of_cohesion({"Z_grown", "/contacts/Z_grown", cohesion_group, per_particle, "Z_{grown}"});
constexpr Quantity tension = of_cohesion({"tension", "/contacts/tension", cohesion_group, "1", "P_{tension}"});
constexpr Quantity mixing = of_mixture({"mixing", "/contacts/mixing", kind_group, "1", "M"}, 2);
constexpr std::array quantities{
    Z,          Z_ff,     Z_ef,         Z_l,           C,          Z_ff_gap,   Z_ff_trough, Z_ef_trough,
    Z_l_trough, C_trough, C_trough_low, C_trough_high, Z_ff_fixed, Z_ef_fixed, Z_l_fixed,   C_fixed,
    Z_1,        Z_2,      Z_3,          Z_4,           Z_11,       Z_12,       Z_13,        Z_14,
    Z_21,       Z_22,     Z_23,         Z_24,          Z_31,       Z_32,       Z_33,        Z_34,
    Z_41,       Z_42,     Z_43,         Z_44,          mixing,     Z_grown,    tension};

Json fit_record(const CdfFit& fit) {
  Json json;
  json["verdict"] = to_string(fit.verdict);
  if (!fit.has_cutoff()) return json;
  put_number(json, "cutoff", fit.cutoff);
  put_number(json, "alpha", fit.alpha);
  put_number(json, "a_0", fit.a[0]);
  put_number(json, "a_0_error", fit.a0_error);
  put_number(json, "error", fit.error);
  return json;
}

Json gap_record(const GapSplit& gap) {
  Json json;
  json["verdict"] = to_string(gap.verdict);
  if (gap.cutoff > 0) put_number(json, "cutoff", gap.cutoff);
  return json;
}

void put_fixed(Json& state, const ContactNumbers& numbers) {
  put(state, Z_ff_fixed, numbers.Z_ff);
  put(state, Z_ef_fixed, numbers.Z_ef);
  put(state, Z_l_fixed, numbers.Z_l);
  put(state, C_fixed, numbers.C);
}

/// `face_face` is true if the face-face cut-off is known, and `all` if both cut-offs are known. `why` is the reason if
/// one is unknown.
struct Known {
  bool face_face, all;
  std::string_view why;
};

void put_numbers(Json& json, const ContactNumbers& n, const Known& known) {
  put_number(json, "Z", n.Z);
  const auto put_if = [&](const char* key, double value, bool is_known) {
    put_optional(json, key, is_known ? std::optional(value) : std::nullopt, known.why);
  };
  put_if("Z_ff", n.Z_ff, known.face_face);
  put_if("Z_ef", n.Z_ef, known.all);
  put_if("Z_l", n.Z_l, known.all);
  put_if("C", n.C, known.all);
}

/// For a mixture: the contact numbers of each kind of particles, and the cut-offs for each pair of shapes.
void put_mixture(Json& contacts, const ContactAnalysis& analysis, const Known& known) {
  for (std::size_t k = 0; k < analysis.of_kinds.size(); ++k)
    put_numbers(contacts["kind_" + std::to_string(k + 1)], analysis.of_kinds[k], known);
  for (const auto& pair : analysis.pairs) {
    Json json;
    json["solids"] = {pair.a->name(), pair.b->name()};
    json["contacts"] = pair.contacts;
    json["face_face_fit"] = fit_record(pair.cutoffs.face_face);
    json["edge_face_fit"] = fit_record(pair.cutoffs.edge_face);
    json["face_face_gap"] = gap_record(pair.cutoffs.face_face_gap);
    json["edge_face_gap"] = gap_record(pair.cutoffs.edge_face_gap);
    contacts["shape_pairs"].push_back(std::move(json));
  }
}

}  // namespace

Json contact_record(const ContactAnalysis& analysis) {
  Json state;
  const auto& n = analysis.numbers;
  put(state, Z, n.Z);
  Json& contacts = state["contacts"];
  put_number(contacts, "Q6", analysis.Q6);
  // If a fit found no cut-off, there is no classification. Numbers that depend on it are then null, not zero.
  const auto why = undecided(analysis);
  const auto put_known = [&](const Quantity& quantity, double value, bool known) {
    put(state, quantity, known ? std::optional(value) : std::nullopt, why.value_or(""));
  };
  put_known(Z_ff, n.Z_ff, analysis.face_face.has_cutoff());
  put_known(Z_ef, n.Z_ef, !why);
  put_known(Z_l, n.Z_l, !why);
  put_known(C, n.C, !why);
  contacts["face_face_fit"] = fit_record(analysis.face_face);
  contacts["edge_face_fit"] = fit_record(analysis.edge_face);
  contacts["face_face_gap"] = gap_record(analysis.face_face_gap);
  contacts["edge_face_gap"] = gap_record(analysis.edge_face_gap);
  put(state, Z_ff_gap, analysis.Z_ff_gap, to_string(analysis.face_face_gap.verdict));
  put_optional(contacts, "Z_ff_disagreement", analysis.disagreement(), "one of the methods gives no cut-off");
  put_fixed(state, analysis.fixed_cutoffs);
  contacts["pooled_over"] = analysis.pooled_over;
  put_mixture(contacts, analysis, {analysis.face_face.has_cutoff(), !why, why.value_or("")});
  return state;
}

std::vector<std::string> contact_flags(const ContactAnalysis& nearest) {
  std::vector<std::string> flags;
  if (undecided(nearest)) {
    flags.emplace_back(to_string(Flag::classes_undecided));
  } else if (nearest.face_face.verdict == FitVerdict::bimodal || nearest.edge_face.verdict == FitVerdict::bimodal) {
    flags.emplace_back(to_string(Flag::classes_doubtful));
  }
  if (nearest.Q6 > crystalline_q6) flags.emplace_back(to_string(Flag::crystalline));
  return flags;
}

namespace {

/// Angles of ideal random contacts between a vertex and a face, for a packing of any shapes. Each shape has the same
/// share of contact ends as in the packing. Either particle of a contact may be the one with the vertex.
class RandomContacts {
 public:
  RandomContacts(const Composition& solids, std::span<const Contact> contacts) {
    if (solids.has_one_shape()) {
      shapes_.push_back({1, RandomAlignment(solids.unit(0))});
      return;
    }
    std::map<std::pair<std::string, const ConvexSolid*>, double> ends;
    for (const auto& contact : contacts) {
      for (const int particle : {contact.pair.a, contact.pair.b}) {
        const auto& unit = solids.unit(static_cast<std::size_t>(particle));
        ends[{unit.name(), &unit}] += 0.5 / static_cast<double>(contacts.size());
      }
    }
    for (const auto& [shape, share] : ends) shapes_.push_back({share, RandomAlignment(*shape.second)});
  }

  double face_face(double theta) const {
    return mean([theta](const RandomAlignment& random) { return random.face_face(theta); });
  }
  double edge_face(double theta) const {
    return mean([theta](const RandomAlignment& random) { return random.edge_face(theta); });
  }
  double ff_max() const {
    return most([](const RandomAlignment& random) { return random.ff_max(); });
  }
  double ef_max() const {
    return most([](const RandomAlignment& random) { return random.ef_max(); });
  }

 private:
  struct Shape {
    double share;
    RandomAlignment random;
  };

  template <class Function>
  double mean(const Function& of) const {
    double sum = 0;
    for (const auto& shape : shapes_) sum += shape.share * of(shape.random);
    return sum;
  }
  template <class Function>
  double most(const Function& of) const {
    double greatest = 0;
    for (const auto& shape : shapes_) greatest = std::max(greatest, of(shape.random));
    return greatest;
  }

  std::vector<Shape> shapes_;
};

/// For a mixture: the mean number Z_ij of contacts of a particle of kind i with particles of kind j, and the mixing M.
/// M is the share of contacts between particles of different kinds, divided by the share that would result if the ends
/// of all contacts were combined at random.
void put_partial(Json& contacts, const Packing& packing, std::span<const Contact> all) {
  const auto kinds = static_cast<std::size_t>(packing.solids.kinds());
  if (kinds < 2) return;
  const auto kind = [&](int i) { return static_cast<std::size_t>(packing.solids.kind(static_cast<std::size_t>(i))); };
  std::vector<long> particles(kinds, 0), ends(kinds * kinds, 0);
  for (int i = 0; i < packing.size(); ++i) ++particles[kind(i)];
  for (const Contact& contact : all) {
    const auto a = kind(contact.pair.a), b = kind(contact.pair.b);
    ++ends[a * kinds + b];
    ++ends[b * kinds + a];
  }
  double like = 0, random_like = 0;
  for (std::size_t i = 0; i < kinds; ++i) {
    long own = 0;
    for (std::size_t j = 0; j < kinds; ++j) {
      const auto count = ends[i * kinds + j];
      put_number(contacts["partial"], fmt::format("Z_{}_{}", i + 1, j + 1),
                 static_cast<double>(count) / static_cast<double>(std::max(particles[i], 1L)));
      own += count;
    }
    like += static_cast<double>(ends[i * kinds + i]);
    random_like += static_cast<double>(own) * static_cast<double>(own);
  }
  const double total = 2 * static_cast<double>(all.size());
  const double unlike = total - like, random_unlike = total > 0 ? total - random_like / total : 0;
  put_optional(contacts, "mixing", random_unlike > 0 ? std::optional(unlike / random_unlike) : std::nullopt,
               "all contacts are between particles of one kind");
}

/// For a packing with cohesion: the number of grown contacts, and the contacts that are under tension.
void put_cohesive(Json& state, const Packing& packing, const ClassifiedContacts& classified, const Cohesion& cohesion) {
  const CohesiveContacts cohesive = cohesive_contacts(packing, classified.contacts, cohesion);
  put(state, Z_grown, 2 * static_cast<double>(cohesive.grown) / packing.size());
  const auto pulled = std::count(cohesive.tension.begin(), cohesive.tension.end(), true);
  put(state, tension, static_cast<double>(pulled) / static_cast<double>(cohesive.tension.size()));
  Json& list = state["contacts"]["under_tension"] = Json::array();
  for (std::size_t k = 0; k < cohesive.tension.size(); ++k) {
    if (cohesive.tension[k]) list.push_back({classified.contacts[k].pair.a, classified.contacts[k].pair.b});
  }
}

/// The alignment angles of a state in ascending order, for plots of their distributions. Also states whether there are
/// more small angles than for random contacts of a vertex with a face.
Json angle_record(const Packing& packing, const ClassifiedContacts& classified) {
  std::vector<double> face_face, edge_face;
  for (const auto& alignment : classified.alignments) {
    face_face.push_back(alignment.face_face);
    edge_face.push_back(alignment.edge_face);
  }
  std::sort(face_face.begin(), face_face.end());
  std::sort(edge_face.begin(), edge_face.end());
  const RandomContacts random(packing.solids, classified.contacts);
  const auto compared = [](const Randomness& randomness) {
    Json json;
    json["verdict"] = to_string(randomness.verdict);
    put_number(json, "angle", randomness.angle);
    json["below"] = randomness.below;
    put_number(json, "expected", randomness.expected);
    put_number(json, "probability", randomness.probability);
    return json;
  };
  Json json;
  json["face_face_random"] = compared(compare_with_random(
      face_face, [&](double theta) { return random.face_face(theta); }, random.ff_max()));
  json["edge_face_random"] = compared(compare_with_random(
      edge_face, [&](double theta) { return random.edge_face(theta); }, random.ef_max()));
  json["face_face"] = std::move(face_face);
  json["edge_face"] = std::move(edge_face);
  return json;
}

/// Contact numbers of the last state of a training cycle.
Json cycle_record(const Cycle& cycle, PackingEnergy& energy) {
  Json json;
  if (!cycle.nearest) {
    for (const auto* key : {"Z", "Z_ff"}) put_absent(json, key, "the last state of the cycle is not known");
    return json;
  }
  const auto classified = classified_contacts(*cycle.nearest, energy);
  put_number(json, "Z", classified.analysis.numbers.Z);
  const bool known = classified.analysis.face_face.has_cutoff();
  put_optional(json, "Z_ff", known ? std::optional(classified.analysis.numbers.Z_ff) : std::nullopt,
               "no face-face cut-off");
  return json;
}

Measurement measure_contacts(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (const Cycle& cycle : jam.cycles)
    measurement.replicate["contacts"]["cycles"].push_back(cycle_record(cycle, energy));
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto classified = classified_contacts(jam.states[k], energy);
    measurement.states.push_back(contact_record(classified.analysis));
    put_trough(measurement.states.back(), histogram_of(classified), jam.states[k].size());
    Json& contacts = measurement.states.back()["contacts"];
    put_partial(contacts, jam.states[k], classified.contacts);
    if (options.cohesion.acts()) put_cohesive(measurement.states.back(), jam.states[k], classified, options.cohesion);
    if (k != nearest) continue;
    measurement.flags = contact_flags(classified.analysis);
    contacts["angles"] = angle_record(jam.states[k], classified);
  }
  return measurement;
}

constexpr std::array flags{Flag::classes_undecided, Flag::classes_doubtful, Flag::crystalline};

}  // namespace

const MeasureDefinition measures::contacts{.quantities = quantities,
                                           .measure = measure_contacts,
                                           .flags = flags,
                                           .by_default = true,
                                           .at_zero_pressure = true};

}  // namespace isojam
