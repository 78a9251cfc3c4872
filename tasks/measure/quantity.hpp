#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tasks/json/json.hpp"
#include "tasks/measure/list.hpp"

namespace isojam {

/// The single definition of a measured quantity: its place in a record, its name in tables, its unit, and how it is
/// averaged. The source of each measure defines its own quantities.
struct Quantity {
  enum class Of : std::uint8_t {
    replicate,  ///< one number per replicate, averaged over replicates
    state       ///< one per state, averaged over replicates nearest jamming and at each of series_distances
  };
  std::string_view name;     ///< key in tables: the paper's symbol
  std::string_view pointer;  ///< JSON pointer from the record (of a replicate) or from a state
  std::string_view group;    ///< table that lists it; the table of main_group is printed first, without a title
  std::string_view unit;     ///< "1" for pure numbers
  std::string_view latex;
  Of of = Of::state;
  /// Measure that computes it, filled in by all_quantities(). Quantities of the protocol itself have none.
  std::optional<Measure> measure = std::nullopt;
};

inline constexpr std::string_view main_group = "jamming", contact_group = "other cut-offs", mode_group = "modes",
                                  exponent_group = "exponents";

/// Every quantity, in the order of tables: φ_J, the quantities of each measure in turn, then those of rearrangements.
/// A group that several measures share comes at the place of the last of them.
std::span<const Quantity> all_quantities();

/// Index in all_quantities(); nullopt if no quantity has that name.
std::optional<std::size_t> quantity_index(std::string_view name);

/// The quantity of that name, which must exist.
const Quantity& quantity(std::string_view name);

/// Writes a quantity to its place in the record of a state or replicate, and creates the objects around it.
void put(Json& record, const Quantity& quantity, double value);
void put(Json& record, const Quantity& quantity, std::integral auto value);
/// Writes the value, or null and the reason.
void put(Json& record, const Quantity& quantity, const std::optional<double>& value, std::string_view reason);

/// Object that holds a quantity (created if it is missing), and the key of the quantity in it.
struct QuantityPlace {
  Json& object;
  std::string key;
};
QuantityPlace place_of(Json& record, const Quantity& quantity);

void put(Json& record, const Quantity& quantity, std::integral auto value) {
  const auto place = place_of(record, quantity);
  place.object[place.key] = value;
}

/// Jamming density of a replicate.
inline constexpr Quantity phi_j_quantity{"phi_j", "/phi_j/phi_j", main_group, "1", "\\phi_J", Quantity::Of::replicate};

/// Values of Δφ at which tables give the quantities of a state, descending. Quantities are interpolated between the
/// states of a replicate, linearly in ln Δφ.
inline constexpr std::array series_distances{.16, .08, .04, .02, .01, .005};

}  // namespace isojam
