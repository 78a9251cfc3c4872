#include "engine/analysis/contacts.hpp"

#include <array>
#include <numbers>
#include <stdexcept>

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
  if (particles < 1) throw std::invalid_argument("contact numbers are per particle: at least 1 particle is needed");
  long face_face = 0, edge_face = 0, lower_order = 0;
  for (const ContactClass contact_class : classes) {
    face_face += contact_class == ContactClass::face_face;
    edge_face += contact_class == ContactClass::edge_face;
    lower_order += contact_class == ContactClass::lower_order;
  }
  // Each contact belongs to two particles. Divided last, so that the sums over classes are exact.
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

std::optional<double> ContactAnalysis::disagreement() const {
  const bool by_fit = face_face.has_cutoff();
  if (!by_fit || !Z_ff_gap) return std::nullopt;
  return *Z_ff_gap - numbers.Z_ff;
}

namespace {

/// All but what belongs to one packing.
ContactAnalysis cutoffs_of(const ConvexSolid& solid, std::span<const std::vector<Alignment>> packings) {
  std::vector<double> face_face, edge_face;
  for (const std::vector<Alignment>& alignments : packings) {
    for (const Alignment& alignment : alignments) {
      face_face.push_back(alignment.face_face);
      edge_face.push_back(alignment.edge_face);
    }
  }
  ContactAnalysis analysis;
  analysis.critical = critical_angles(solid);
  analysis.face_face = fit_cdf(face_face, analysis.critical.ff_min() / 2);
  analysis.edge_face = fit_cdf(edge_face, analysis.critical.ef_min() / 2);
  analysis.face_face_gap = split_at_gap(face_face, analysis.critical.ff_min() / 2);
  analysis.edge_face_gap = split_at_gap(edge_face, analysis.critical.ef_min() / 2);
  analysis.pooled_over = static_cast<int>(packings.size());
  return analysis;
}

}  // namespace

std::vector<ContactAnalysis> analyse_pooled(const ConvexSolid& solid, int particles,
                                            std::span<const std::vector<Alignment>> packings) {
  std::vector<ContactAnalysis> analyses(packings.size(), cutoffs_of(solid, packings));
  for (std::size_t k = 0; k < packings.size(); ++k) {
    ContactAnalysis& analysis = analyses[k];
    const std::vector<Alignment>& alignments = packings[k];
    analysis.classes = classify(alignments, analysis.face_face.cutoff, analysis.edge_face.cutoff);
    analysis.numbers = contact_numbers(particles, analysis.classes);
    analysis.fixed_cutoffs = fixed_cutoff_numbers(particles, alignments);
    if (analysis.face_face_gap.cutoff > 0)
      analysis.Z_ff_gap = contact_numbers(particles, classify(alignments, analysis.face_face_gap.cutoff, 0)).Z_ff;
  }
  return analyses;
}

ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments) {
  const std::vector<Alignment> own(alignments.begin(), alignments.end());
  return analyse_pooled(solid, particles, std::span(&own, 1)).front();
}

}  // namespace isojam
