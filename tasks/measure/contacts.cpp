#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/analysis/cohesive_contacts.hpp"
#include "engine/analysis/order.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/contact_fields.hpp"
#include "tasks/measure/flag.hpp"

namespace isojam {
namespace {

FitRecord fit_record(const CdfFit& fit) {
  if (!fit.has_cutoff()) return {fit.verdict, {}, {}, {}, {}, {}};
  return {fit.verdict, fit.cutoff, fit.alpha, fit.a[0], fit.a0_error, fit.error};
}

CutoffRecords cutoff_records(const ClassCutoffs& cutoffs) {
  return {fit_record(cutoffs.face_face), fit_record(cutoffs.edge_face)};
}

/// If a fit found no cut-off, there is no classification. Numbers that depend on it are then null, not zero.
KnownNumbers known_numbers(const ContactNumbers& n, const ContactAnalysis& analysis) {
  const auto why = undecided(analysis);
  const auto value = [&](double number) { return given(!why, number, why.value_or("")); };
  return {n.Z, given(analysis.face_face.has_cutoff(), n.Z_ff, why.value_or("")), value(n.Z_ef), value(n.Z_l),
          value(n.C)};
}

}  // namespace

Contacts contact_record(const ContactAnalysis& analysis) {
  Contacts record;
  record.numbers = known_numbers(analysis.numbers, analysis);
  record.Q6 = analysis.Q6;
  record.cutoffs = cutoff_records(analysis);
  record.fixed_cutoffs = analysis.fixed_cutoffs;
  for (const auto& numbers : analysis.of_kinds) record.kinds.push_back(known_numbers(numbers, analysis));
  if (!analysis.pairs.empty()) record.shape_pairs.emplace();
  for (const auto& pair : analysis.pairs)
    record.shape_pairs->push_back({{pair.a->name(), pair.b->name()}, pair.contacts, cutoff_records(pair.cutoffs)});
  return record;
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
void add_partial(Contacts& record, const Packing& packing, std::span<const Contact> all) {
  const auto kinds = static_cast<std::size_t>(packing.solids.kinds());
  if (kinds < 2) return;
  const auto kind = [&](int i) { return static_cast<std::size_t>(packing.solids.kind(static_cast<std::size_t>(i))); };
  std::vector<long> particles(kinds, 0);
  std::vector<std::vector<long>> ends(kinds, std::vector<long>(kinds, 0));
  for (int i = 0; i < packing.size(); ++i) ++particles[kind(i)];
  for (const Contact& contact : all) {
    const auto a = kind(contact.pair.a), b = kind(contact.pair.b);
    ++ends[a][b];
    ++ends[b][a];
  }
  double like = 0, random_like = 0;
  record.partial.emplace();
  for (std::size_t i = 0; i < kinds; ++i) {
    auto& row = record.partial->Z.emplace_back();
    for (const long count : ends[i])
      row.push_back(static_cast<double>(count) / static_cast<double>(std::max(particles[i], 1L)));
    const auto own = static_cast<double>(std::accumulate(ends[i].begin(), ends[i].end(), 0L));
    like += static_cast<double>(ends[i][i]);
    random_like += own * own;
  }
  const double total = 2 * static_cast<double>(all.size());
  const double unlike = total - like, random_unlike = total > 0 ? total - random_like / total : 0;
  record.mixing = given(random_unlike > 0, unlike / random_unlike, "all contacts are between particles of one kind");
}

/// For a packing with cohesion: the number of grown contacts, and the contacts that are under tension.
void add_cohesive(Contacts& record, const Packing& packing, const std::vector<Contact>& all, const Cohesion& cohesion) {
  const CohesiveContacts cohesive = cohesive_contacts(packing, all, cohesion);
  record.Z_grown = 2 * static_cast<double>(cohesive.grown) / packing.size();
  auto& list = record.under_tension.emplace();
  for (std::size_t k = 0; k < cohesive.tension.size(); ++k) {
    if (cohesive.tension[k]) list.push_back({all[k].pair.a, all[k].pair.b});
  }
  record.tension = static_cast<double>(list.size()) / static_cast<double>(cohesive.tension.size());
}

/// The alignment angles of a state in ascending order, for plots of their distributions. Also states whether there are
/// more small angles than for random contacts of a vertex with a face.
Angles angle_record(const Packing& packing, const ClassifiedContacts& classified) {
  Angles record;
  for (const auto& alignment : classified.alignments) {
    record.face_face.push_back(alignment.face_face);
    record.edge_face.push_back(alignment.edge_face);
  }
  std::sort(record.face_face.begin(), record.face_face.end());
  std::sort(record.edge_face.begin(), record.edge_face.end());
  const RandomContacts random(packing.solids, classified.contacts);
  record.face_face_random = compare_with_random(
      record.face_face, [&](double theta) { return random.face_face(theta); }, random.ff_max());
  record.edge_face_random = compare_with_random(
      record.edge_face, [&](double theta) { return random.edge_face(theta); }, random.ef_max());
  return record;
}

/// Contact numbers of the last state of a training cycle.
CycleRecord cycle_record(const Cycle& cycle, PackingEnergy& energy) {
  const Reasoned<> none{std::nullopt, "the last state of the cycle is not known"};
  if (!cycle.nearest) return {none, none};
  const auto analysis = classified_contacts(*cycle.nearest, energy).analysis;
  return {{analysis.numbers.Z, ""},
          given(analysis.face_face.has_cutoff(), analysis.numbers.Z_ff, "no face-face cut-off")};
}

Measurement measure_contacts(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  ContactsOfReplicate replicate;
  if (!jam.cycles.empty()) replicate.contacts.emplace();
  for (const Cycle& cycle : jam.cycles) replicate.contacts->cycles.push_back(cycle_record(cycle, energy));
  measurement.replicate = written(replicate);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const Packing& packing = jam.states[k];
    const auto classified = classified_contacts(packing, energy, options.gap);
    ContactsOfState state{contact_record(classified.analysis)};
    const AngleHistogram histogram = histogram_of(classified);
    state.contacts.angle_bins = bins_of(histogram);
    state.contacts.trough = troughs_of(histogram, packing.size());
    add_partial(state.contacts, packing, classified.contacts);
    if (options.cohesion.acts()) add_cohesive(state.contacts, packing, classified.contacts, options.cohesion);
    if (k == nearest) {
      measurement.flags = contact_flags(classified.analysis);
      state.contacts.angles = angle_record(packing, classified);
    }
    measurement.states.push_back(written(state));
  }
  return measurement;
}

constexpr std::array flags{Flag::classes_undecided, Flag::classes_doubtful, Flag::crystalline};

}  // namespace

const MeasureDefinition measures::contacts{.state = part_of<ContactsOfState>(),
                                           .replicate = part_of<ContactsOfReplicate>(),
                                           .measure = measure_contacts,
                                           .flags = flags,
                                           .by_default = true,
                                           .at_zero_pressure = true,
                                           .as_given = true};

}  // namespace isojam
