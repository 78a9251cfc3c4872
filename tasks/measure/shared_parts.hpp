#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/measure/measure.hpp"

// Functions shared by the measures.

namespace isojam {

/// Precision of all measures. They use both doubles of each coordinate, even if the minimiser used only the first.
inline constexpr Precision state_precision = Precision::double_double;

/// The contacts of a state, their alignment angles and their classes.
struct ClassifiedContacts {
  std::vector<Contact> contacts;
  std::vector<Alignment> alignments;
  ContactAnalysis analysis;
};
ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy);

/// The reason why the contacts cannot be classified; nullopt if they can.
std::optional<std::string_view> undecided(const ContactAnalysis& analysis);

/// JSON with Z and its contributions, C, Q6, and the fits that give the cut-offs.
Json contact_record(const ContactAnalysis& analysis);
/// The flags of the measure `contacts` that the nearest state causes: classes_undecided or classes_doubtful, and
/// crystalline. See Flag.
std::vector<std::string> contact_flags(const ContactAnalysis& nearest);

/// The finite number x, rounded to `digits` significant digits. Rounding keeps the text of long lists short.
double to_digits(double x, int digits);

/// Numbers of positive values in logarithmic bins, five per decade. The same bins are used for all states.
class Histogram {
 public:
  static constexpr int per_decade = 5;
  /// `bins` bins that begin at 10^(least/per_decade).
  Histogram(int least, int bins) : least_(least), counts_(static_cast<std::size_t>(bins), 0) {}
  /// Values above the last bin are counted in the last bin. Values below the first bin, and 0, are counted separately.
  void add(double value);
  /// JSON with the counts.
  Json record() const;
  /// Base-10 logarithms of the lower edges of all bins and of the upper edge of the last bin.
  Json edges() const;

 private:
  int least_;
  long below_ = 0;
  std::vector<long> counts_;
};

/// The reason why a state cannot be relaxed in a variable cell or sheared: its pressure is not positive, or its
/// residual is above 1e-3. nullopt if it can.
std::optional<std::string_view> not_jammed(const Packing& packing, PackingEnergy& energy);

/// Fits the exponent of y ∝ Δφ^exponent to the states with Δφ ≤ scaling_window. Writes the exponent, its
/// ci95_half_width and the number of fitted states to the record of a replicate. `y` has one element for each state; an
/// element is nullopt if y is unknown in this state.
void put_scaling(Json& replicate, const Quantity& exponent, const JamResult& jam,
                 const std::vector<std::optional<double>>& y);
/// Largest Δφ of the states in these fits. It is the default fit window of φ_J. At larger Δφ, y does not follow one
/// power law.
inline constexpr double scaling_window = 0.02;

}  // namespace isojam
