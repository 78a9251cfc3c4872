#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tasks/io/describe.hpp"
#include "tasks/measure/list.hpp"

namespace isojam {

/// A field of a record that is a column of tables, as all_quantities() collects it from the descriptions of the fields.
struct Quantity {
  enum class Of : std::uint8_t {
    replicate,  ///< one value per replicate; means are over replicates
    /// one value per state; means are over the nearest states of replicates, or over values that are interpolated at
    /// each of series_distances
    state
  };
  std::string name;     ///< name in tables: the symbol of the paper, if there is one
  std::string pointer;  ///< JSON pointer to the value in the record of a replicate, or in the object of a state
  QuantityGroup group;  ///< the table of main_group is the first one
  std::string unit;     ///< "1" for a pure number
  std::string latex;    ///< symbol
  std::string meaning;
  Of of = Of::state;
  std::optional<Measure> measure = std::nullopt;  ///< nullopt for quantities of the protocol
  bool proportion = false;                        ///< true if each value is 0 or 1, so that the mean is a proportion
  int kinds = 1;          ///< smallest number of kinds of particles for which a packing has the quantity
  bool cohesive = false;  ///< true if only packings with cohesion at zero pressure have the quantity
};

/// Groups that are used in several source files.
inline constexpr QuantityGroup main_group{
    "jamming", "Density and contacts of the state nearest jamming, with cut-offs that are fitted to the angles."};
inline constexpr QuantityGroup contact_group{
    "other cut-offs", "The same contacts with other cut-offs, for example fixed angles from 5° to 55°."};

/// All quantities, in the order of tables: φ_J, then the quantities of each measure, then those of rearrangements. All
/// quantities of a group are together. If several measures have quantities in a group, the group is at the position of
/// the last of these measures.
std::span<const Quantity> all_quantities();

/// Index of the quantity with this name in all_quantities(); nullopt if there is none.
std::optional<std::size_t> quantity_index(std::string_view name);

/// The quantity with this name, which must exist.
const Quantity& quantity(std::string_view name);

/// True if tables list the quantity also if it has no value in any row.
inline bool is_always_listed(const Quantity& quantity) { return quantity.group == main_group && !quantity.cohesive; }

/// Values of Δφ, descending, for which tables give the quantities of states. They are interpolated linearly in ln Δφ
/// between two states of a replicate.
inline constexpr std::array series_distances{.16, .08, .04, .02, .01, .005, .0025, .001, .0005};

}  // namespace isojam
