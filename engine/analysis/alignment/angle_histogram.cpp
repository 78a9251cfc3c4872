#include "engine/analysis/alignment/angle_histogram.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

using Edges = std::array<double, angle_bins + 1>;

const Edges& edges() {
  static const Edges list = [] {
    Edges all{};
    for (int k = 0; k <= angle_bins; ++k)
      all[static_cast<std::size_t>(k)] = nearest::pow(10, angle_bins_from + k / double{angle_bins_per_decade});
    return all;
  }();
  return list;
}

}  // namespace

double angle_bin_edge(int k) { return edges().at(static_cast<std::size_t>(k)); }

int angle_bin(double angle) {
  if (!(angle >= 0) || !(angle < edges().back()))
    throw std::invalid_argument("angles of a histogram must be from 0 to π");
  const auto above = std::upper_bound(edges().begin(), edges().end(), angle);
  return std::max(0, static_cast<int>(above - edges().begin()) - 1);
}

int angle_bins_below(double upper) {
  const auto above = std::upper_bound(edges().begin(), edges().end(), upper);
  return std::max(0, static_cast<int>(above - edges().begin()) - 1);
}

double AngleHistogram::contacts() const { return std::accumulate(face_face.begin(), face_face.end(), 0.0); }

void AngleHistogram::add(const AngleHistogram& other, double weight) {
  for (std::size_t k = 0; k < angle_bins; ++k) {
    face_face[k] += weight * other.face_face[k];
    edge_face_apart[k] += weight * other.edge_face_apart[k];
  }
  const auto place = [](const Cell& cell) { return std::pair(cell.face_face, cell.edge_face); };
  std::vector<Cell> merged;
  auto own = cells.begin();
  for (const Cell& cell : other.cells) {
    while (own != cells.end() && place(*own) < place(cell)) merged.push_back(*own++);
    const bool both = own != cells.end() && place(*own) == place(cell);
    merged.push_back({cell.face_face, cell.edge_face, (both ? own->contacts : 0) + weight * cell.contacts});
    if (both) ++own;
  }
  merged.insert(merged.end(), own, cells.end());
  cells = std::move(merged);
  face_face_window = std::min(face_face_window, other.face_face_window);
  edge_face_window = std::min(edge_face_window, other.edge_face_window);
}

std::vector<double> AngleHistogram::edge_face_of_others(int face_face_bins) const {
  assert(face_face_bins <= face_face_window);
  std::vector<double> others = edge_face_apart;
  for (const Cell& cell : cells) {
    if (cell.face_face >= face_face_bins) others[static_cast<std::size_t>(cell.edge_face)] += cell.contacts;
  }
  return others;
}

AngleHistogram angle_histogram(std::span<const Alignment> alignments, double ff_upper, double ef_upper) {
  AngleHistogram histogram;
  histogram.face_face_window = angle_bins_below(ff_upper);
  histogram.edge_face_window = angle_bins_below(ef_upper);
  std::map<std::pair<int, int>, double> cells;
  for (const Alignment& alignment : alignments) {
    const int ff = angle_bin(alignment.face_face), ef = angle_bin(alignment.edge_face);
    ++histogram.face_face[static_cast<std::size_t>(ff)];
    if (ff < histogram.face_face_window) {
      ++cells[{ff, ef}];
    } else {
      ++histogram.edge_face_apart[static_cast<std::size_t>(ef)];
    }
  }
  for (const auto& [place, contacts] : cells) histogram.cells.push_back({place.first, place.second, contacts});
  return histogram;
}

}  // namespace isojam
