#include "engine/analysis/contacts.hpp"

#include <stdexcept>

namespace isojam {

std::string_view to_string(ContactClass contact_class) {
  switch (contact_class) {
    case ContactClass::face_face: return "face_face";
    case ContactClass::edge_face: return "edge_face";
    case ContactClass::lower_order: return "lower_order";
  }
  throw std::invalid_argument("not a contact class");
}

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

ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments) {
  std::vector<double> face_face, edge_face;
  for (const Alignment& alignment : alignments) {
    face_face.push_back(alignment.face_face);
    edge_face.push_back(alignment.edge_face);
  }
  ContactAnalysis analysis;
  analysis.critical = critical_angles(solid);
  analysis.face_face = fit_cdf(face_face, analysis.critical.ff_min() / 2);
  analysis.edge_face = fit_cdf(edge_face, analysis.critical.ef_min() / 2);
  analysis.classes = classify(alignments, analysis.face_face.cutoff, analysis.edge_face.cutoff);
  analysis.numbers = contact_numbers(particles, analysis.classes);
  return analysis;
}

}  // namespace isojam
