#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tasks/io/json.hpp"
#include "tasks/measure/list.hpp"

namespace isojam {

/// Definition of a measured quantity: its JSON pointer in a record, its name in tables, its unit, and how it is
/// averaged. The source file of each measure defines the quantities of the measure.
struct Quantity {
  enum class Of : std::uint8_t {
    replicate,  ///< the quantity has one value per replicate, which is averaged over replicates
    /// the quantity has one value per state; the average over replicates uses the state nearest jamming, or
    /// interpolated values at each of series_distances
    state
  };
  std::string_view name;     ///< name in tables, which is the symbol of the paper
  std::string_view pointer;  ///< JSON pointer, relative to the record of the replicate or to the object of a state
  /// title of the table that lists the quantity; the table of main_group is printed first, without a title
  std::string_view group;
  std::string_view unit;  ///< "1" for pure numbers
  std::string_view latex;
  Of of = Of::state;
  /// Measure that computes the quantity; all_quantities() sets it. Quantities of the protocol itself have no measure.
  std::optional<Measure> measure = std::nullopt;
};

inline constexpr std::string_view main_group = "jamming", contact_group = "other cut-offs", mode_group = "modes",
                                  exponent_group = "exponents";

/// Place in the record of a state of the numbers of each kind of particles, "kind_1" and so on. Only mixtures have
/// them.
inline constexpr std::string_view kinds_pointer = "/contacts/kind_";

/// All quantities, in the order of tables: φ_J, then the quantities of each measure, then the quantities of
/// rearrangements. If several measures have quantities in the same group, the group has the position of the last of
/// these measures.
std::span<const Quantity> all_quantities();

/// Index in all_quantities() of the quantity with this name; nullopt if there is none.
std::optional<std::size_t> quantity_index(std::string_view name);

/// The quantity with this name. It must exist.
const Quantity& quantity(std::string_view name);

/// Writes the value of a quantity to the record of a state or replicate, at the pointer of the quantity. Missing
/// objects are created.
void put(Json& record, const Quantity& quantity, double value);
void put(Json& record, const Quantity& quantity, std::integral auto value);
/// Writes the value, or null and the reason if there is no value.
void put(Json& record, const Quantity& quantity, const std::optional<double>& value, std::string_view reason);

/// The object that contains a quantity, and the key of the quantity in this object. A missing object is created.
struct QuantityPlace {
  Json& object;
  std::string key;
};
QuantityPlace place_of(Json& record, const Quantity& quantity);

void put(Json& record, const Quantity& quantity, std::integral auto value) {
  const auto place = place_of(record, quantity);
  place.object[place.key] = value;
}

/// The jamming density φ_J of a replicate.
inline constexpr Quantity phi_j_quantity{"phi_j", "/phi_j/phi_j", main_group, "1", "\\phi_J", Quantity::Of::replicate};

/// Values of Δφ, descending, at which a series of tables gives the quantities of states. The values of a replicate are
/// interpolated linearly in ln Δφ between its states.
inline constexpr std::array series_distances{.16, .08, .04, .02, .01, .005};

}  // namespace isojam
