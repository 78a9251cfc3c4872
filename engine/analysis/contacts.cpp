#include "engine/analysis/contacts.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace isojam {

std::vector<ContactClass> classify(std::span<const Alignment> alignments, double ff_cutoff, double ef_cutoff) {
  std::vector<ContactClass> classes;
  classes.reserve(alignments.size());
  for (const Alignment& alignment : alignments) {
    if (alignment.face_face < ff_cutoff) {
      classes.push_back(ContactClass::face_face);
    } else if (alignment.edge_face < ef_cutoff) {
      classes.push_back(ContactClass::edge_face);
    } else {
      classes.push_back(ContactClass::lower_order);
    }
  }
  return classes;
}

ContactNumbers contact_numbers(int particles, std::span<const ContactClass> classes) {
  if (particles < 1) throw std::invalid_argument("contact numbers need at least one particle");
  long face_face = 0, edge_face = 0, lower_order = 0;
  for (const ContactClass contact_class : classes) {
    face_face += contact_class == ContactClass::face_face;
    edge_face += contact_class == ContactClass::edge_face;
    lower_order += contact_class == ContactClass::lower_order;
  }
  // Each contact belongs to two particles. The division comes last, so that the sums over classes are exact.
  const auto per_particle = [&](long count) { return static_cast<double>(2 * count) / particles; };
  return {.Z = per_particle(face_face + edge_face + lower_order),
          .Z_ff = per_particle(face_face),
          .Z_ef = per_particle(edge_face),
          .Z_l = per_particle(lower_order),
          .C = per_particle(3 * face_face + 2 * edge_face + lower_order)};
}

ContactNumbers fixed_cutoff_numbers(int particles, std::span<const Alignment> alignments) {
  constexpr std::array degrees{5, 15, 25, 35, 45, 55};
  ContactNumbers mean;
  for (const int angle : degrees) {
    const double cutoff = angle * std::numbers::pi / 180;
    const ContactNumbers numbers = contact_numbers(particles, classify(alignments, cutoff, cutoff));
    mean.Z += numbers.Z / degrees.size();
    mean.Z_ff += numbers.Z_ff / degrees.size();
    mean.Z_ef += numbers.Z_ef / degrees.size();
    mean.Z_l += numbers.Z_l / degrees.size();
    mean.C += numbers.C / degrees.size();
  }
  return mean;
}

const ClassCutoffs& ContactAnalysis::cutoffs_of(const ConvexSolid& a, const ConvexSolid& b) const {
  for (const ShapePair& pair : pairs) {
    if ((pair.a == &a && pair.b == &b) || (pair.a == &b && pair.b == &a)) return pair.cutoffs;
  }
  return *this;
}

namespace {

/// Accuracy of alignment angles of parallel features (radians).
constexpr double resolution = 1e-12;

/// True if the angles in a window can be distinguished from 0. A solid with faces that are nearly in one plane has a
/// smaller window.
bool is_resolved(double upper) { return upper > resolution; }

CdfFit fit_of(std::span<const double> angles, double upper) {
  return is_resolved(upper) ? fit_cdf(angles, upper) : CdfFit{.verdict = FitVerdict::too_few};
}

ClassCutoffs cutoffs_of(const CriticalAngles& critical, std::span<const Alignment> alignments) {
  std::vector<double> face_face, edge_face;
  for (const Alignment& alignment : alignments) {
    face_face.push_back(alignment.face_face);
    edge_face.push_back(alignment.edge_face);
  }
  ClassCutoffs cutoffs;
  cutoffs.critical = critical;
  cutoffs.face_face = fit_of(face_face, critical.ff_min() / 2);
  cutoffs.edge_face = fit_of(edge_face, critical.ef_min() / 2);
  return cutoffs;
}

/// Numbers per particle for each kind. A contact counts for the kinds of both of its particles.
std::vector<ContactNumbers> numbers_of_kinds(const Composition& solids, int particles,
                                             std::span<const Contact> contacts, std::span<const ContactClass> classes) {
  struct Counts {
    long particles = 0;
    std::array<long, 3> ends{};
  };
  std::vector<Counts> counts(static_cast<std::size_t>(solids.kinds()));
  const auto of = [&](int i) -> Counts& {
    return counts[static_cast<std::size_t>(solids.kind(static_cast<std::size_t>(i)))];
  };
  for (int i = 0; i < particles; ++i) ++of(i).particles;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto which = static_cast<std::size_t>(classes[k]);
    ++of(contacts[k].pair.a).ends[which];
    ++of(contacts[k].pair.b).ends[which];
  }
  std::vector<ContactNumbers> numbers;
  for (const Counts& kind : counts) {
    const auto [ff, ef, l] = kind.ends;
    // A kind without particles has no contacts either.
    const auto per = static_cast<double>(std::max(kind.particles, 1L));
    const auto mean = [per](long ends) { return static_cast<double>(ends) / per; };
    numbers.push_back(
        {.Z = mean(ff + ef + l), .Z_ff = mean(ff), .Z_ef = mean(ef), .Z_l = mean(l), .C = mean(3 * ff + 2 * ef + l)});
  }
  return numbers;
}

/// True if the fit a is less conclusive than the fit b.
bool is_vaguer(const CdfFit& a, const CdfFit& b) {
  if (a.has_cutoff() != b.has_cutoff()) return b.has_cutoff();
  return a.verdict == FitVerdict::bimodal && b.verdict == FitVerdict::fitted;
}

/// One pair of shapes of a mixture, and its contacts.
struct Group {
  ShapePair pair;
  std::vector<std::size_t> members;
  std::vector<Alignment> alignments;
};

/// The groups, sorted by the names of their shapes.
std::vector<Group> groups_of(const Composition& solids, std::span<const Contact> contacts,
                             std::span<const Alignment> alignments) {
  std::vector<Group> groups;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ConvexSolid *a = &solids.unit(static_cast<std::size_t>(contacts[k].pair.a)),
                      *b = &solids.unit(static_cast<std::size_t>(contacts[k].pair.b));
    if (std::pair(b->name(), b) < std::pair(a->name(), a)) std::swap(a, b);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& each) { return each.pair.a == a && each.pair.b == b; });
    if (group == groups.end()) group = groups.insert(group, Group{{a, b, 0, {}}, {}, {}});
    ++group->pair.contacts;
    group->members.push_back(k);
    group->alignments.push_back(alignments[k]);
  }
  std::sort(groups.begin(), groups.end(), [](const Group& p, const Group& q) {
    return std::pair(p.pair.a->name(), p.pair.b->name()) < std::pair(q.pair.a->name(), q.pair.b->name());
  });
  return groups;
}

/// Replaces results in `all` by the less conclusive results of `pair`.
void take_vaguer(const ShapePair& pair, ContactAnalysis& all) {
  const ClassCutoffs& cutoffs = pair.cutoffs;
  if (is_vaguer(cutoffs.face_face, all.face_face)) all.face_face = cutoffs.face_face;
  if (is_vaguer(cutoffs.edge_face, all.edge_face)) all.edge_face = cutoffs.edge_face;
  all.critical.take_lesser(cutoffs.critical);
}

ContactAnalysis analyse_mixture(const Composition& solids, int particles, std::span<const Contact> contacts,
                                std::span<const Alignment> alignments) {
  ContactAnalysis analysis;
  analysis.classes.resize(contacts.size());
  for (Group& group : groups_of(solids, contacts, alignments)) {
    ShapePair& pair = group.pair;
    pair.cutoffs = cutoffs_of(critical_angles(*pair.a, *pair.b), group.alignments);
    const auto classes = classify(group.alignments, pair.cutoffs.face_face.cutoff, pair.cutoffs.edge_face.cutoff);
    for (std::size_t k = 0; k < group.members.size(); ++k) analysis.classes[group.members[k]] = classes[k];
    if (analysis.pairs.empty()) {
      static_cast<ClassCutoffs&>(analysis) = pair.cutoffs;
    } else {
      take_vaguer(pair, analysis);
    }
    analysis.pairs.push_back(pair);
  }
  analysis.numbers = contact_numbers(particles, analysis.classes);
  analysis.fixed_cutoffs = fixed_cutoff_numbers(particles, alignments);
  analysis.of_kinds = numbers_of_kinds(solids, particles, contacts, analysis.classes);
  return analysis;
}

}  // namespace

ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments) {
  ContactAnalysis analysis;
  static_cast<ClassCutoffs&>(analysis) = cutoffs_of(critical_angles(solid), alignments);
  analysis.classes = classify(alignments, analysis.face_face.cutoff, analysis.edge_face.cutoff);
  analysis.numbers = contact_numbers(particles, analysis.classes);
  analysis.fixed_cutoffs = fixed_cutoff_numbers(particles, alignments);
  return analysis;
}

ContactAnalysis analyse_contacts(const Composition& solids, int particles, std::span<const Contact> contacts,
                                 std::span<const Alignment> alignments) {
  if (solids.has_one_shape()) {
    ContactAnalysis analysis = analyse_contacts(solids.unit(0), particles, alignments);
    if (!solids.is_uniform()) analysis.of_kinds = numbers_of_kinds(solids, particles, contacts, analysis.classes);
    return analysis;
  }
  return analyse_mixture(solids, particles, contacts, alignments);
}

}  // namespace isojam
