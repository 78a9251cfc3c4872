#include "engine/analysis/gaps.hpp"

#include "engine/analysis/contact_force.hpp"
#include "engine/analysis/pair_distribution.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Distributions of the gaps between near neighbours, of the contact forces and of the distances between centres. The
// bins are the same for all states.

struct Gaps {
  Reasoned<> within_distance;
  std::vector<double> log10_gap;
  Histogram faces, edges;
  Reasoned<> weak_forces;
  bool classes_told = false;
  std::vector<double> log10_force;
  Histogram face_face, edge_face, lower_order;
  std::vector<double> r, g;
};
void describe(Fields& field, Gaps& gaps) {
  constexpr QuantityGroup group{"gaps and forces",
                                "Number of pairs with a gap below Δφ·V_p^(1/3), and share of weak contact forces."};
  field("within_distance", gaps.within_distance,
        "Number of pairs, per particle, that do not touch and whose gap is below Δφ·V_p^(1/3). Each pair counts for "
        "both of its particles. The value is null if Δφ is not between 0 and 0.1.")
      .unit("per particle")
      .column({"gaps_within_distance", group, "Z_{h<\\Delta\\phi}"});
  field("log10_gap", gaps.log10_gap, "Edges of the bins of the gaps: log10 of the gap in units of V_p^(1/3).").detail();
  field("faces", gaps.faces,
        "Histogram of the gaps of pairs for which the two separating planes are parallel to a face.")
      .detail();
  field("edges", gaps.edges,
        "Histogram of the gaps of pairs for which the two separating planes are parallel to an edge of each particle.")
      .detail();
  field("weak_forces", gaps.weak_forces,
        "Share of the contacts whose force is less than a tenth of the mean contact force.")
      .column({"weak_forces", group, "P(f<\\langle f\\rangle/10)"});
  field("classes_told", gaps.classes_told,
        "True if the contacts are classified. If false, the histogram `lower_order` contains all forces.");
  field("log10_force", gaps.log10_force,
        "Edges of the bins of the forces: log10 of the force divided by the mean contact force.")
      .detail();
  field("face_face", gaps.face_face, "Histogram of the forces of face-face contacts.").detail();
  field("edge_face", gaps.edge_face, "Histogram of the forces of edge-face contacts.").detail();
  field("lower_order", gaps.lower_order, "Histogram of the forces of lower-order contacts.").detail();
  field("r", gaps.r,
        "Edges of the bins of the distance r between the centres of two particles (V_p^(1/3)). The last one is at most "
        "5, and at most half of the shortest lattice translation.")
      .range(not_negative)
      .detail();
  field("g", gaps.g,
        "Pair distribution function g(r) in each of these bins: the number of particles at this distance from a "
        "particle, divided by the number in an ideal gas of the same density.")
      .range(not_negative)
      .detail();
}

struct State {
  Gaps gaps;
};
void describe(Fields& field, State& state) {
  field("gaps", state.gaps,
        "Histograms of the gaps of pairs that nearly touch, and of the contact forces. The gap of a pair is the "
        "largest distance of two separating planes that are parallel to a face of one particle, or to an edge of each. "
        "The bins are logarithmic.");
}

/// Ranges. Gaps are from 1e-8 to 0.1 V_p^(1/3), forces from 1e-6 to 10^1.6 in units of their mean.
constexpr int least_gap = -8 * Histogram::per_decade, gap_bins = 7 * Histogram::per_decade;
constexpr int least_force = -6 * Histogram::per_decade, force_bins = 38;
constexpr double widest = 0.1;
constexpr double weak = 0.1;

void add_gaps(Gaps& record, const Packing& packing, double distance) {
  record.faces = record.edges = Histogram(least_gap, gap_bins);
  long near = 0;
  for (const Gap& gap : near_gaps(packing, widest)) {
    (gap.of_faces ? record.faces : record.edges).add(gap.width);
    near += gap.width < distance;
  }
  record.within_distance = given(distance > 0 && distance <= widest, 2 * static_cast<double>(near) / packing.size(),
                                 "Δφ is not between 0 and .1");
  record.log10_gap = record.faces.edges();
}

void add_forces(Gaps& record, const Packing& packing, const ClassifiedContacts& classified) {
  const auto forces = contact_forces(packing, classified.contacts);
  double sum = 0;
  for (const auto& force : forces) sum += force.force_a.norm();
  const double mean = forces.empty() ? 0 : sum / static_cast<double>(forces.size());
  record.classes_told = !undecided(classified.analysis) && mean > 0;
  record.face_face = record.edge_face = record.lower_order = Histogram(least_force, force_bins);
  Histogram* const by_class[] = {&record.face_face, &record.edge_face, &record.lower_order};
  long few = 0;
  for (std::size_t k = 0; k < forces.size() && mean > 0; ++k) {
    const double f = forces[k].force_a.norm() / mean;
    few += f < weak;
    by_class[record.classes_told ? static_cast<std::size_t>(classified.analysis.classes[k]) : 2]->add(f);
  }
  record.weak_forces =
      given(mean > 0, static_cast<double>(few) / static_cast<double>(forces.size()), "nothing touches");
  record.log10_force = record.face_face.edges();
}

/// Bins of g(r) (V_p^(1/3)).
constexpr double r_width = 0.1, farthest_r = 5;

void add_pair_distribution(Gaps& record, const Packing& packing) {
  const auto g = pair_distribution(packing, r_width, farthest_r);
  for (std::size_t k = 0; k <= g.size(); ++k) record.r.push_back(to_digits(r_width * static_cast<double>(k), 4));
  for (const double value : g) record.g.push_back(to_digits(value, 6));
}

Measurement measure_gaps(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    State state;
    add_gaps(state.gaps, packing, jam.phi_j ? packing.density() - jam.phi_j->density : 0);
    add_forces(state.gaps, packing, classified_contacts(packing, energy));
    add_pair_distribution(state.gaps, packing);
    measurement.states.push_back(written(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::gaps{.state = part_of<State>(), .measure = measure_gaps, .as_given = true};

}  // namespace isojam
