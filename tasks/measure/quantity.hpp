#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tasks/json/json.hpp"
#include "tasks/measure/list.hpp"

namespace isojam {

/// A measured number, told once: where it stands in a record, what tables call it, in which unit, and how it is
/// averaged. A row of the table of quantities, which the source of each measure adds its rows to.
struct Quantity {
  enum class Of : std::uint8_t {
    replicate,  ///< one number per replicate, averaged over replicates
    state       ///< one per state: averaged over replicates nearest jamming, and at each of series_distances
  };
  std::string_view name;     ///< key in tables: the paper's symbol
  std::string_view pointer;  ///< JSON pointer from the record (of a replicate) or from a state
  std::string_view group;    ///< the table it belongs to; that of main_group is printed first and without a title
  std::string_view unit;     ///< "1" for pure numbers
  std::string_view latex;
  Of of = Of::state;
  /// That gives it; all_quantities() fills it in. What the expansion itself tells needs none.
  std::optional<Measure> measure = std::nullopt;
};

inline constexpr std::string_view main_group = "jamming", contact_group = "other cut-offs", mode_group = "modes",
                                  exponent_group = "exponents";

/// Every quantity, in the order of tables: φ_J, those of each measure in turn, those of rearrangements; a group that
/// several measures share stands where the last of them leaves it.
std::span<const Quantity> all_quantities();

/// The index in all_quantities(); nullopt if there is none of that name.
std::optional<std::size_t> quantity_index(std::string_view name);

/// The quantity of that name, which exists.
const Quantity& quantity(std::string_view name);

/// Writes a quantity where it stands in the record of a state or replicate, making the objects on the way.
void put(Json& record, const Quantity& quantity, double value);
void put(Json& record, const Quantity& quantity, std::integral auto value);
/// The value, or null and the reason.
void put(Json& record, const Quantity& quantity, const std::optional<double>& value, std::string_view reason);

/// The object that holds a quantity, made if it is not there, and the key of the quantity in it.
struct QuantityPlace {
  Json& object;
  std::string key;
};
QuantityPlace place_of(Json& record, const Quantity& quantity);

void put(Json& record, const Quantity& quantity, std::integral auto value) {
  const auto place = place_of(record, quantity);
  place.object[place.key] = value;
}

/// The jamming density of a replicate.
inline constexpr Quantity phi_j_quantity{"phi_j", "/phi_j/phi_j", main_group, "1", "\\phi_J", Quantity::Of::replicate};

/// Δφ at which tables give the quantities of a state, interpolated between the states of a replicate linearly in
/// ln Δφ; descending.
inline constexpr std::array series_distances{.16, .08, .04, .02, .01, .005};

}  // namespace isojam
