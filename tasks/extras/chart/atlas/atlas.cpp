#include "tasks/extras/chart/atlas/atlas.hpp"

#include <iterator>

namespace isojam {

std::vector<AtlasRow> stability_atlas(const AtlasOptions& options) {
  std::vector<AtlasRow> rows;
  const auto append = [&rows](std::vector<AtlasRow> part) {
    rows.insert(rows.end(), std::move_iterator(part.begin()), std::move_iterator(part.end()));
  };
  const auto goes_on = [&options](const char* part) {
    if (options.progress) options.progress(part);
    return !options.stop.stop_requested();
  };
  if (goes_on("overlaps")) append(overlap_atlas());
  if (goes_on("energies")) append(packing_atlas());
  if (!options.jammed_states || !goes_on("jamming its octahedra")) return rows;
  const AtlasStates states(options.stop);
  if (goes_on("minimisers")) append(minimiser_atlas(states, options.stop));
  if (goes_on("modes")) append(modes_atlas(states, options.stop));
  return rows;
}

}  // namespace isojam
