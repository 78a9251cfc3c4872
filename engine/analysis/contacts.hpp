#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/analysis/alignment.hpp"
#include "engine/analysis/cdf_fit.hpp"
#include "engine/analysis/critical_angles.hpp"

namespace isojam {

enum class ContactClass { face_face, edge_face, lower_order };
std::string_view to_string(ContactClass contact_class);

/// Mean numbers per particle. C = 3 Z_ff + 2 Z_ef + Z_l.
struct ContactNumbers {
  double Z = 0, Z_ff = 0, Z_ef = 0, Z_l = 0, C = 0;
};

struct ContactAnalysis {
  CdfFit face_face, edge_face;
  CriticalAngles critical;
  std::vector<ContactClass> classes;  ///< per contact, in the order given
  ContactNumbers numbers;
  double Q6 = 0;  ///< contact_q6 of the state, for whoever has its contacts and not just their angles
};

/// Classifies by the cut-offs of the two CDF fits on [0, θ_c,min/2] each: face-face if θ_ff < its cut-off,
/// edge-face if θ_ef < its cut-off and not face-face, lower order otherwise. A collapsed fit leaves its cut-off at 0.
ContactAnalysis analyse_contacts(const ConvexSolid& solid, int particles, std::span<const Alignment> alignments);

/// Classes for given cut-offs (radians).
std::vector<ContactClass> classify(std::span<const Alignment> alignments, double ff_cutoff, double ef_cutoff);
/// Each contact counts for two particles. Throws std::invalid_argument if particles < 1.
ContactNumbers contact_numbers(int particles, std::span<const ContactClass> classes);

}  // namespace isojam
