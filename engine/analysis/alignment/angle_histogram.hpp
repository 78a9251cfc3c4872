#pragma once

#include <span>
#include <vector>

#include "engine/analysis/alignment/alignment.hpp"

namespace isojam {

/// Number of bins per decade, and number of all bins. The bins cover the angles from 1e-12 to 10^0.5 > π radians. The
/// accuracy of alignment angles of parallel features is 1e-12. Smaller angles are in the first bin.
inline constexpr int angle_bins_per_decade = 20, angle_bins = 250;
/// Decimal logarithm of the lower edge of the first bin (angles in radians).
inline constexpr int angle_bins_from = -12;

/// Lower edge of bin k in radians, for 0 ≤ k ≤ angle_bins: 10^(−12 + k/20).
double angle_bin_edge(int k);
/// The bin k with angle_bin_edge(k) ≤ angle < angle_bin_edge(k + 1). Throws std::invalid_argument if the angle is
/// negative, not finite, or too large for the bins.
int angle_bin(double angle);
/// Number of bins whose angles are all below `upper` (radians).
int angle_bins_below(double upper);

/// Numbers of contacts in bins of the logarithms of their alignment angles. Numbers are not integers if histograms are
/// combined with weights.
struct AngleHistogram {
  std::vector<double> face_face = std::vector<double>(angle_bins);  ///< number of contacts in each bin of θ_ff
  /// Contacts with both angles in given bins. angle_histogram() lists only the contacts with θ_ff in the first
  /// `face_face_window` bins. add() keeps cells beyond the smaller of both windows.
  struct Cell {
    int face_face = 0, edge_face = 0;  ///< bins of the two angles
    double contacts = 0;
  };
  std::vector<Cell> cells;  ///< sorted by (face_face, edge_face), without repetition
  /// number of contacts in each bin of θ_ef, without the contacts in `cells`
  std::vector<double> edge_face_apart = std::vector<double>(angle_bins);
  /// The cut-offs of θ_ff and θ_ef must lie in the first `face_face_window` and `edge_face_window` bins. A window is 0
  /// if the upper limit of the cut-off is below the accuracy of the angles.
  int face_face_window = 0, edge_face_window = 0;

  double contacts() const;  ///< number of all contacts
  /// Adds `weight` times another histogram. Each window is then the smaller of the two.
  void add(const AngleHistogram& other, double weight = 1);
  /// Number of contacts in each bin of θ_ef. Only contacts whose bin of θ_ff is `face_face_bins` or above are counted;
  /// with face_face_bins = 0, these are all contacts. Requires face_face_bins ≤ face_face_window.
  std::vector<double> edge_face_of_others(int face_face_bins) const;
};

/// Makes the histogram of the contacts. The cut-offs of θ_ff and θ_ef must be below `ff_upper` and `ef_upper`
/// (radians), usually half of the smallest critical angles.
AngleHistogram angle_histogram(std::span<const Alignment> alignments, double ff_upper, double ef_upper);

}  // namespace isojam
