#include "tasks/extras/chart/atlas/atlas_runs.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace isojam {
namespace {

using Cells = std::vector<const AtlasRow*>;

/// The cells of each regime and method. Cells of one method are grouped, although in the atlas regimes and methods can
/// alternate.
std::vector<Cells> by_regime_and_method(std::span<const AtlasRow> rows) {
  std::map<std::string, std::size_t> regimes, methods;  // in order of appearance
  std::map<std::pair<std::size_t, std::size_t>, Cells> cells;
  for (const AtlasRow& row : rows) {
    const std::size_t regime = regimes.try_emplace(row.regime, regimes.size()).first->second;
    const std::size_t method = methods.try_emplace(row.method, methods.size()).first->second;
    cells[{regime, method}].push_back(&row);
  }
  std::vector<Cells> all;
  for (auto& [place, some] : cells) all.push_back(std::move(some));
  return all;
}

bool alike(const AtlasRow& a, const AtlasRow& b) {
  return a.verdict == b.verdict && (a.verdict == AtlasVerdict::holds || a.reason == b.reason);
}

/// Text for the settings of the cells with these indices. Consecutive cells are written as a range.
std::string settings_text(const Cells& cells, const std::vector<std::size_t>& places) {
  std::string text;
  for (std::size_t k = 0; k < places.size();) {
    std::size_t last = k;
    while (last + 1 < places.size() && places[last + 1] == places[last] + 1) ++last;
    if (!text.empty()) text += ", ";
    text += cells[places[k]]->setting;
    if (last > k) text += (last == k + 1 ? ", " : " … ") + cells[places[last]]->setting;
    k = last + 1;
  }
  return text;
}

void append_runs(const Cells& cells, std::vector<AtlasRun>& runs) {
  std::vector<std::vector<std::size_t>> kinds;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& each) { return alike(*cells[each[0]], *cells[k]); });
    if (kind == kinds.end()) {
      kinds.push_back({k});
    } else {
      kind->push_back(k);
    }
  }
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](const auto& a, const auto& b) { return cells[a[0]]->verdict < cells[b[0]]->verdict; });
  for (const auto& places : kinds) {
    const AtlasRow& first = *cells[places[0]];
    runs.push_back({first.regime, first.method, first.standard, first.verdict, settings_text(cells, places),
                    first.figure, first.reason});
  }
}

}  // namespace

std::vector<AtlasRun> atlas_runs(std::span<const AtlasRow> rows) {
  std::vector<AtlasRun> runs;
  for (const Cells& cells : by_regime_and_method(rows)) append_runs(cells, runs);
  return runs;
}

}  // namespace isojam
