#include "tasks/tables/pooled_trough.hpp"

#include <cstddef>

#include "tasks/io/hash.hpp"

namespace isojam {

PackedAngles::PackedAngles(const AngleHistogram& histogram)
    : face_face_window_(static_cast<std::uint8_t>(histogram.face_face_window)),
      edge_face_window_(static_cast<std::uint8_t>(histogram.edge_face_window)) {
  const auto add = [&](int face_face, int edge_face, double contacts) {
    if (contacts == 0) return;
    entries_.push_back(
        {static_cast<std::uint8_t>(face_face), static_cast<std::uint8_t>(edge_face), static_cast<float>(contacts)});
  };
  for (int k = 0; k < angle_bins; ++k) {
    add(k, any, histogram.face_face[static_cast<std::size_t>(k)]);
    add(any, k, histogram.edge_face_apart[static_cast<std::size_t>(k)]);
  }
  for (const auto& cell : histogram.cells) add(cell.face_face, cell.edge_face, cell.contacts);
  entries_.shrink_to_fit();
}

AngleHistogram PackedAngles::unpacked() const {
  AngleHistogram histogram;
  histogram.face_face_window = face_face_window_;
  histogram.edge_face_window = edge_face_window_;
  for (const auto& [face_face, edge_face, contacts] : entries_) {
    if (edge_face == any) {
      histogram.face_face[face_face] = contacts;
    } else if (face_face == any) {
      histogram.edge_face_apart[edge_face] = contacts;
    } else {
      histogram.cells.push_back({face_face, edge_face, contacts});
    }
  }
  return histogram;
}

std::optional<PooledTrough> pooled_trough(const std::vector<const PackedAngles*>& packings, int particles,
                                          const std::string& key) {
  if (packings.empty()) return std::nullopt;
  PooledTrough pooled{.replicates = static_cast<int>(packings.size()),
                      .particles = static_cast<double>(particles) * static_cast<double>(packings.size())};
  AngleHistogram total = packings.front()->unpacked();
  for (std::size_t k = 1; k < packings.size(); ++k) total.add(packings[k]->unpacked());
  pooled.cutoffs = trough_cutoffs(total);
  std::array<std::vector<double>, PooledTrough::names.size()> values;
  for (const PackedAngles* packing : packings) {
    const auto [n, C_low, C_high] = trough_numbers(packing->unpacked(), particles, pooled.cutoffs);
    if (pooled.cutoffs.has_face_face()) values[0].push_back(n.Z_ff);
    if (!pooled.cutoffs.has_all()) continue;
    const std::array others{n.Z_ef, n.Z_l, n.C, C_low, C_high};
    for (std::size_t i = 0; i < others.size(); ++i) values[i + 1].push_back(others[i]);
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    pooled.estimates[i] = estimate(values[i], hash_of(key + std::string(PooledTrough::names[i])));
  return pooled;
}

}  // namespace isojam
