#include "engine/analysis/exponents.hpp"

#include <algorithm>
#include <numeric>

#include "engine/arithmetic/elementary.hpp"
#include "engine/vibration/backbone.hpp"
#include "tasks/measure/rank_parts.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Classifies contacts by their exponents x, which needs no cut-off angle, and counts the constraints that are missing.

constexpr QuantityGroup group{
    "constraints",
    "Contacts and constraints of the state nearest jamming, with classes from the exponents of contacts."};

/// The particles that remain if underconstrained particles are removed, repeatedly, until there are none.
struct Supported {
  Reasoned<int> removed;
  Reasoned<> C, missing;
  Reasoned<int> self_stress;
};

struct Exponents {
  Reasoned<> Z_ff, Z_ef, Z_l, C, C_low, C_high, missing, missing_low, missing_high, between;
  Rank rank;
  Supported supported;
  double step = 0;
  int broken = 0, formed = 0;
  std::vector<std::optional<double>> x;
};

void describe(Fields& field, Supported& supported) {
  field("removed", supported.removed, "Number of underconstrained particles that were removed.")
      .column(
          {"underconstrained", group, "n_u",
           "Number of particles that are underconstrained: their own constraints do not suppress their six motions "
           "even while all other particles are fixed. Those that become so by the removal of others are included."});
  field("C", supported.C, "Constraint number of the remaining particles.")
      .unit("per particle")
      .column({"C_supported", group, "C^{su}", "Constraint number C without underconstrained particles."});
  field("missing", supported.missing, "Missing constraints of the remaining particles.")
      .unit("per particle")
      .column({"m_supported", group, "m^{su}", "Missing constraints m without underconstrained particles."});
  field("self_stress", supported.self_stress, "Number of states of self-stress of the remaining particles.");
}

void describe_classes(Fields& field, Exponents& exponents) {
  const auto add = [&](const char* key, Reasoned<>& value, const char* name, const char* latex, const char* meaning) {
    field(key, value, meaning).unit("per particle").column({name, group, latex});
  };
  add("C", exponents.C, "C_x", "C^x", "Constraint number C = 3 Z_ff + 2 Z_ef + Z_l with classes from exponents.");
  add("C_low", exponents.C_low, "C_x_low", "C^x_{low}",
      "Constraint number C if contacts are face-face with x < −4 and edge-face with x < 0.3. (`C_high` − `C_low`)/2 is "
      "the systematic error of C from the boundaries of the classes.");
  add("C_high", exponents.C_high, "C_x_high", "C^x_{high}",
      "Constraint number C if contacts are face-face with x < −1 and edge-face with x < 0.7.");
  add("missing", exponents.missing, "m", "m",
      "Missing constraints: (6N − 3 − rank)/N, where the rank is that of the rigidity matrix with classes from "
      "exponents. It is 0 if the constraints suppress all motions but translations.");
  add("missing_low", exponents.missing_low, "m_low", "m_{low}",
      "Missing constraints with the classes of `C_high`, which have the most constraints.");
  add("missing_high", exponents.missing_high, "m_high", "m_{high}",
      "Missing constraints with the classes of `C_low`, which have the fewest constraints.");
  add("Z_ff", exponents.Z_ff, "Z_ff_x", "Z_{ff}^x", "Number of face-face contacts per particle: x < −2.5.");
  add("Z_ef", exponents.Z_ef, "Z_ef_x", "Z_{ef}^x", "Number of edge-face contacts per particle: −2.5 ≤ x < 0.5.");
  add("Z_l", exponents.Z_l, "Z_l_x", "Z_l^x", "Number of lower-order contacts per particle: x ≥ 0.5, or broken.");
  add("between", exponents.between, "Z_between", "Z_{0.3..0.7}",
      "Number of contacts per particle with 0.3 < x < 0.7, between the classes edge-face and lower-order.");
}

void describe(Fields& field, Exponents& exponents) {
  describe_classes(field, exponents);
  const std::string condition = "if the classes of the contacts come from their exponents.";
  field.nested(
      "rank", [&, condition](Fields& inner) { describe_rank(inner, exponents.rank, "x", "x", condition); },
      "Rigidity matrix in which a face-face contact has three constraints, an edge-face contact two and a lower-order "
      "contact one.");
  field("supported", exponents.supported,
        "The same without underconstrained particles, which are removed repeatedly until there are none. Each contact "
        "keeps the class that it has in the whole packing.");
  field("step", exponents.step,
        "Relative change of Δφ in the step from which the exponents were computed; 0 if no step was possible.")
      .range({-1, 1});
  field("broken", exponents.broken, "Number of contacts that break in this step. They have no exponent.");
  field("formed", exponents.formed, "Number of contacts that form in this step.");
  field("x", exponents.x,
        "Exponents x = d ln(|S|²/V) / d ln f^(1/5) of the contacts, in the order of the contacts; null for a contact "
        "that breaks.")
      .detail();
}

struct State {
  std::optional<Exponents> exponents;
};
void describe(Fields& field, State& state) {
  field(
      "exponents", state.exponents,
      "Classes of the contacts from their exponents. Unless `exponents_of_all_states` is true, only the state nearest "
      "jamming has this field.");
}

double per_particle(long count, int particles) { return 2 * static_cast<double>(count) / particles; }

/// (6N − 3 − rank)/N.
Reasoned<> missing(const Rank& rank, int particles) {
  return reasoned(rank.floppy.value ? std::optional((*rank.floppy.value - 3.0) / particles) : std::nullopt,
                  rank.floppy.reason);
}

struct Followed {
  ClassifiedContacts classified;
  ContactExponents exponents;

  /// The faces and edges of a contact are parallel only to within angles ~ Δφ^(5/3) (theory.md), so that singular
  /// values of this size are not resolved.
  RigidityOptions accuracy() const { return {.least_tolerance = nearest::pow(exponents.distance, 5. / 3)}; }

  std::vector<ContactClass> classes(const ExponentBoundaries& boundaries = {}) const {
    return classes_of(exponents, classified.alignments, boundaries);
  }
};

/// Removes underconstrained particles until none is left.
void add_supported(Supported& record, const Packing& packing, const Followed& followed,
                   std::span<const ContactClass> all_classes) {
  std::vector<int> kept(static_cast<std::size_t>(packing.size()));
  std::iota(kept.begin(), kept.end(), 0);
  while (!kept.empty()) {
    const Packing part = part_of(packing, kept);
    const auto within = contacts_within(followed.classified.contacts, kept, packing.size());
    std::vector<Alignment> alignments;
    std::vector<ContactClass> classes;
    for (const auto place : within.places) {
      alignments.push_back(followed.classified.alignments[place]);
      classes.push_back(all_classes[place]);
    }
    const auto matrix = class_constraints(part, within.contacts, alignments, classes);
    const auto loose = underconstrained(matrix, part.size());
    if (loose.empty()) {
      const auto rank = rank_of(matrix, followed.accuracy());
      record.C.value = contact_numbers(part.size(), classes).C;
      record.missing = missing(rank, part.size());
      record.self_stress = rank.self_stress;
      break;
    }
    std::for_each(loose.rbegin(), loose.rend(), [&](auto i) { kept.erase(kept.begin() + i); });
  }
  record.removed.value = packing.size() - static_cast<int>(kept.size());
  if (kept.empty()) record.C.reason = record.missing.reason = record.self_stress.reason = "no particle is left";
}

void add_classes(Exponents& record, const Packing& packing, const Followed& followed) {
  const int n = packing.size();
  const ClassifiedContacts& known = followed.classified;
  const auto rank = [&](std::span<const ContactClass> classes) {
    return rank_of(class_constraints(packing, known.contacts, known.alignments, classes), followed.accuracy());
  };
  const auto classes = followed.classes(), fewest = followed.classes(fewest_constraints),
             most = followed.classes(most_constraints);
  const auto numbers = contact_numbers(n, classes);
  record.Z_ff.value = numbers.Z_ff;
  record.Z_ef.value = numbers.Z_ef;
  record.Z_l.value = numbers.Z_l;
  record.C.value = numbers.C;
  record.C_low.value = contact_numbers(n, fewest).C;
  record.C_high.value = contact_numbers(n, most).C;
  const auto is_between = [](const auto& x) {
    return x && *x > fewest_constraints.edge_face && *x < most_constraints.edge_face;
  };
  record.between.value = per_particle(std::ranges::count_if(followed.exponents.x, is_between), n);
  record.rank = rank(classes);
  record.missing = missing(record.rank, n);
  record.missing_low = missing(rank(most), n);
  record.missing_high = missing(rank(fewest), n);
  add_supported(record.supported, packing, followed, classes);
}

void add_nothing(Exponents& record, std::string_view why) {
  for (auto* value :
       {&record.Z_ff, &record.Z_ef, &record.Z_l, &record.C, &record.C_low, &record.C_high, &record.missing,
        &record.missing_low, &record.missing_high, &record.between, &record.supported.C, &record.supported.missing})
    value->reason = why;
  record.rank = no_rank(why);
  record.supported.self_stress.reason = record.supported.removed.reason = why;
}

Exponents exponents_of(const Packing& packing, PackingEnergy& energy) {
  Followed followed{classified_contacts(packing, energy), {}};
  followed.exponents = contact_exponents(packing, followed.classified.contacts, energy);
  Exponents record;
  record.step = followed.exponents.step;
  record.broken = followed.exponents.broken;
  record.formed = followed.exponents.formed;
  if (record.step == 0) {
    add_nothing(record, "no equilibrium was found at a slightly different density");
    return record;
  }
  add_classes(record, packing, followed);
  constexpr int digits = 4;
  for (const auto& x : followed.exponents.x)
    record.x.push_back(x ? std::optional(to_digits(*x, digits)) : std::nullopt);
  return record;
}

Measurement measure_exponents(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    State state;
    if (options.exponents_of_all_states || k == nearest) state.exponents = exponents_of(jam.states[k], energy);
    measurement.states.push_back(written(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::exponents{.state = part_of<State>(), .measure = measure_exponents};

}  // namespace isojam
