#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/measure/measure.hpp"

// Functions shared by the measures.

namespace isojam {

/// Precision of all measures. They use both doubles of each coordinate, even if the minimiser used only the first.
inline constexpr Precision state_precision = Precision::double_double;

/// The contacts of a state.
struct StateContacts {
  std::vector<Contact> contacts;
  std::vector<double> gaps;  ///< gap of each contact: 0 if the particles overlap
};
/// All contacts, sorted by (a, b, shift). With gap > 0, pairs with a smaller gap count too, see as_contact().
StateContacts contacts_of(const Packing& packing, PackingEnergy& energy, double gap);

/// The contacts of a state, their alignment angles and their classes.
struct ClassifiedContacts : StateContacts {
  std::vector<Alignment> alignments;
  ContactAnalysis analysis;
};
ClassifiedContacts classified_contacts(const Packing& packing, PackingEnergy& energy, double gap = 0);

/// The reason why the contacts cannot be classified; nullopt if they can.
std::optional<std::string_view> undecided(const ContactAnalysis& analysis);

/// A value that is known, or the reason why it is not.
template <class T>
Reasoned<T> given(bool is_known, T value, std::string_view reason) {
  return reasoned(is_known ? std::optional(std::move(value)) : std::nullopt, reason);
}

/// The finite number x, rounded to `digits` significant digits. Rounding keeps the text of long lists short.
double to_digits(double x, int digits);

/// Numbers of positive values in logarithmic bins, five per decade. The same bins are used for all states.
struct Histogram {
  static constexpr int per_decade = 5;
  Histogram() = default;
  /// `bins` bins that begin at 10^(least/per_decade).
  Histogram(int from, int bins) : least(from), counts(static_cast<std::size_t>(bins), 0) {}
  /// Values above the last bin are counted in the last bin. Values below the first bin, and 0, are counted separately.
  void add(double value);
  /// Base-10 logarithms of the lower edges of all bins and of the upper edge of the last bin.
  std::vector<double> edges() const;

  int least = 0;
  long below = 0;
  std::vector<long> counts;
};
void describe(Fields& field, Histogram& bins);

/// The reason why a state cannot be relaxed in a variable cell or sheared: its pressure is not positive, or its
/// residual is above 1e-3. nullopt if it can.
std::optional<std::string_view> not_jammed(const Packing& packing, PackingEnergy& energy);

/// Power law y ∝ Δφ^exponent.
struct Scaling {
  Reasoned<> exponent, ci95_half_width;
  int points = 0;  ///< number of fitted states
};
/// Fits the law to the states with Δφ ≤ scaling_window. `y` has one element for each state; an element is nullopt if y
/// is unknown in this state.
Scaling scaling_of(const JamResult& jam, const std::vector<std::optional<double>>& y);
/// Adds the law of the quantity with this symbol. The exponent is a quantity too; its name is "x_" and `name`.
void add_scaling(Fields& field, const std::string& key, Scaling& law, const std::string& name, std::string_view latex,
                 std::string_view symbol, const Words& meaning);
/// Largest Δφ of the states in these fits. It is the default fit window of φ_J. At larger Δφ, y does not follow one
/// power law.
inline constexpr double scaling_window = 0.02;

}  // namespace isojam
