#pragma once

#include "engine/analysis/alignment/angle_histogram.hpp"
#include "engine/analysis/alignment/trough.hpp"
#include "engine/analysis/contacts.hpp"

namespace isojam {

/// Cut-offs of the contact classes in the troughs of the densities of log10 θ. They assume no form of the densities.
struct TroughCutoffs {
  Trough face_face;  ///< trough of the density of θ_ff, of all contacts
  /// Trough of the density of θ_ef, of the contacts that are not face-face: the edges of two parallel faces would form
  /// a third population. If θ_ff has no trough, all contacts are used.
  Trough edge_face;

  bool has_face_face() const { return face_face.verdict == TroughVerdict::found; }  ///< true if Z_ff is known
  /// true if all contact numbers are known
  bool has_all() const { return has_face_face() && edge_face.verdict == TroughVerdict::found; }
};

/// Finds both cut-offs. For pooled cut-offs, pass the sum of the histograms of several packings.
TroughCutoffs trough_cutoffs(const AngleHistogram& histogram);

/// Contact numbers, and constraint numbers at the edges of the troughs.
struct TroughNumbers {
  ContactNumbers numbers;  ///< with both cut-offs at the minima of the density
  /// Constraint number with both cut-offs at the lower edges of their troughs, and at the upper edges. Half of the
  /// difference is the systematic error of C.
  double C_low = 0, C_high = 0;
};

/// Contact numbers of a packing, with cut-offs from its own histogram or from a pooled one. If a cut-off is unknown, it
/// is 0, so no contact is in its class.
TroughNumbers trough_numbers(const AngleHistogram& histogram, int particles, const TroughCutoffs& cutoffs);

/// Contact numbers per particle. Contacts are face-face if θ_ff is in the first `face_face_bins` bins, and otherwise
/// edge-face if θ_ef is in the first `edge_face_bins` bins. The classes are those of classify() with the cut-offs
/// angle_bin_edge(face_face_bins) and angle_bin_edge(edge_face_bins), or 0 instead of angle_bin_edge(0). Throws
/// std::invalid_argument if particles < 1.
ContactNumbers numbers_in_bins(const AngleHistogram& histogram, int particles, int face_face_bins, int edge_face_bins);

}  // namespace isojam
