#include "tasks/chart/atlas/atlas.hpp"

#include <array>
#include <cstddef>
#include <iterator>

namespace isojam {

std::string_view to_string(AtlasVerdict verdict) {
  static constexpr std::array<std::string_view, 3> names{"holds", "refuses", "fails"};
  return names[static_cast<std::size_t>(verdict)];
}

std::vector<AtlasRow> stability_atlas(const AtlasOptions& options) {
  std::vector<AtlasRow> rows;
  const auto append = [&rows](std::vector<AtlasRow> part) {
    rows.insert(rows.end(), std::move_iterator(part.begin()), std::move_iterator(part.end()));
  };
  append(overlap_atlas());
  append(packing_atlas());
  if (options.jammed_states) {
    append(minimiser_atlas());
    append(modes_atlas());
  }
  return rows;
}

}  // namespace isojam
