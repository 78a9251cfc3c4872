#include "tasks/columns.hpp"

#include <algorithm>

namespace isojam {
namespace {

/// The first key of a column's pointer, where it is not that of a state's contacts.
struct Home {
  std::string_view key;
  Measure measure;
};
constexpr std::array homes{Home{"/order/", Measure::order},      Home{"/clusters/", Measure::clusters},
                           Home{"/modes/", Measure::modes},      Home{"/mode_scaling/", Measure::modes},
                           Home{"/moduli/", Measure::moduli},    Home{"/moduli_scaling/", Measure::moduli},
                           Home{"/rigidity/", Measure::rigidity}};

}  // namespace

std::optional<Measure> measure_of(const Column& column) {
  if (column.pointer.starts_with("/phi_j/")) return std::nullopt;
  const auto home =
      std::find_if(homes.begin(), homes.end(), [&](const Home& h) { return column.pointer.starts_with(h.key); });
  return home == homes.end() ? Measure::contacts : home->measure;
}

}  // namespace isojam
