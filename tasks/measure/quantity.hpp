#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tasks/io/describe.hpp"
#include "tasks/io/json.hpp"
#include "tasks/measure/list.hpp"

namespace isojam {

/// Definition of a quantity: its place in a record, its name in tables, its unit, and how it is averaged. The source
/// file of a measure defines the quantities of the measure.
struct Quantity {
  enum class Of : std::uint8_t {
    replicate,  ///< one value per replicate; means are over replicates
    /// one value per state; means are over the nearest states of replicates, or over values that are interpolated at
    /// each of series_distances
    state
  };
  std::string_view name;     ///< name in tables: the symbol of the paper, if there is one
  std::string_view pointer;  ///< JSON pointer to the value in the record of a replicate, or in the object of a state
  QuantityGroup group;       ///< the table of main_group is the first one
  std::string_view unit;     ///< "1" for a pure number
  /// symbol in LaTeX
  std::string_view latex;
  Of of = Of::state;
  /// Measure that computes the quantity, set by all_quantities(). nullopt for quantities of the protocol.
  std::optional<Measure> measure = std::nullopt;
  bool proportion = false;  ///< true if each value is 0 or 1, so that the mean is a proportion
  /// smallest number of kinds of particles for which a packing has the quantity
  int kinds = 1;
  bool cohesive = false;  ///< true if only packings with cohesion at zero pressure have the quantity
};

/// The same quantity, with values that are 0 or 1.
constexpr Quantity proportion(Quantity quantity) {
  quantity.proportion = true;
  return quantity;
}

/// The same quantity, for mixtures of at least `kinds` kinds of particles.
constexpr Quantity of_mixture(Quantity quantity, int kinds) {
  quantity.kinds = kinds;
  return quantity;
}

/// The same quantity, which only packings with cohesion at zero pressure have.
constexpr Quantity of_cohesion(Quantity quantity) {
  quantity.cohesive = true;
  return quantity;
}

/// Groups that are used in several source files.
inline constexpr QuantityGroup main_group{
    "jamming", "Density and contacts of the state nearest jamming, with cut-offs that are fitted to the angles."};
inline constexpr QuantityGroup contact_group{
    "other cut-offs", "The same contacts with other cut-offs: a gap in the angles, and fixed angles from 5° to 55°."};
inline constexpr QuantityGroup mode_group{"modes", "Vibrational modes at both ends of the spectrum."};
inline constexpr QuantityGroup exponent_group{"exponents", "Exponents of power laws in the distance to jamming Δφ."};

/// All quantities, in the order of tables: φ_J, then the quantities of each measure, then those of rearrangements. All
/// quantities of a group are together. If several measures have quantities in a group, the group is at the position of
/// the last of these measures.
std::span<const Quantity> all_quantities();

/// Index of the quantity with this name in all_quantities(); nullopt if there is none.
std::optional<std::size_t> quantity_index(std::string_view name);

/// The quantity with this name, which must exist.
const Quantity& quantity(std::string_view name);

/// Writes the value of a quantity to the record of a state or a replicate, at the pointer of the quantity. Creates
/// missing objects on the way.
void put(Json& record, const Quantity& quantity, double value);
void put(Json& record, const Quantity& quantity, std::integral auto value);
/// Writes the value of a quantity, or null and the reason if there is no value.
void put(Json& record, const Quantity& quantity, const std::optional<double>& value, std::string_view reason);

/// The object that contains a quantity, and the key of the quantity in it. place_of() creates missing objects.
struct QuantityPlace {
  Json& object;
  std::string key;
};
QuantityPlace place_of(Json& record, const Quantity& quantity);

void put(Json& record, const Quantity& quantity, std::integral auto value) {
  const auto place = place_of(record, quantity);
  place.object[place.key] = value;
}

/// True if tables list the quantity also if it has no value in any row.
inline bool is_always_listed(const Quantity& quantity) { return quantity.group == main_group && !quantity.cohesive; }

/// The jamming density φ_J of a replicate.
inline constexpr Quantity phi_j_quantity{"phi_j", "/phi_j/phi_j", main_group, "1", "\\phi_J", Quantity::Of::replicate};
/// The density φ_0 at zero pressure of a replicate with cohesion.
inline constexpr Quantity phi_0_quantity =
    of_cohesion({"phi_0", "/phi_0", main_group, "1", "\\phi_0", Quantity::Of::replicate});

/// Values of Δφ, descending, for which tables give the quantities of states. They are interpolated linearly in ln Δφ
/// between two states of a replicate.
inline constexpr std::array series_distances{.16, .08, .04, .02, .01, .005, .0025, .001, .0005};

}  // namespace isojam
