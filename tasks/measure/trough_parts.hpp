#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/analysis/trough_classes.hpp"
#include "tasks/io/describe.hpp"
#include "tasks/measure/shared_parts.hpp"

// Parts of records about the classification of contacts by troughs.

namespace isojam {

/// A trough in a record. What is optional is absent if no trough was found.
struct TroughRecord {
  TroughVerdict verdict = TroughVerdict::not_called;
  double excess = 0, critical = 0;
  std::optional<double> cutoff, low, high;
  std::optional<double> density;  ///< per particle: each contact counts for both of its particles
  std::optional<double> depth, kernel;
};
TroughRecord trough_record(const Trough& trough, double particles);
void describe(Fields& field, TroughRecord& trough);

/// The troughs of a state, and the contact numbers with cut-offs in them.
struct Troughs {
  TroughRecord face_face, edge_face;
  Reasoned<> Z_ff, Z_ef, Z_l, C, C_low, C_high;
};
Troughs troughs_of(const AngleHistogram& histogram, int particles);
void describe(Fields& field, Troughs& troughs);

/// Numbers of contacts from the first to the last bin that is not empty. Bin k begins at log10 θ = k/20.
struct AngleCounts {
  long first = 0;
  std::vector<long> counts;
};
void describe(Fields& field, AngleCounts& counts);
/// The histogram of the alignment angles of a state.
struct AngleBins {
  double width = 0;
  AngleCounts face_face, edge_face;
  int face_face_end = 0, edge_face_end = 0;
  std::vector<long> cells;
};
AngleBins bins_of(const AngleHistogram& histogram);
void describe(Fields& field, AngleBins& angles);

/// The histogram of the alignment angles of a state, and the bins in which cut-offs may lie. These bins are below half
/// of the smallest critical angle over all pairs of shapes.
AngleHistogram histogram_of(const ClassifiedContacts& classified);

/// The reason why there are no contact numbers by troughs; nullopt if there are.
std::optional<std::string_view> undecided(const TroughCutoffs& cutoffs);

/// Reads the histogram of a state from its place. Throws InputError if it is damaged.
AngleHistogram read_angle_histogram(const JsonPlace& place);
/// JSON pointer to the histogram in the record of a state.
inline constexpr std::string_view angle_bins_pointer = "/contacts/angle_bins";

}  // namespace isojam
