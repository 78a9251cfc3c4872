#include "tasks/tables/pooled_trough.hpp"

#include <cmath>
#include <cstddef>

namespace isojam {

PackedAngles::PackedAngles(const AngleHistogram& histogram)
    : face_face_window_(static_cast<std::uint8_t>(histogram.face_face_window)),
      edge_face_window_(static_cast<std::uint8_t>(histogram.edge_face_window)) {
  const auto add = [&](int face_face, int edge_face, double number) {
    constexpr double multiples = 1 << 16;
    const double contacts = std::round(number * multiples) / multiples;
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

void PooledAngles::Group::add(const AngleHistogram& histogram) {
  if (replicates++ == 0) {
    sum = histogram;
  } else {
    sum.add(histogram);
  }
}

void PooledAngles::add(const std::string& study, int replicate, const AngleHistogram& histogram) {
  const auto combine = [&](const std::pair<std::string, int>& name, const PackedAngles& angles) {
    const auto number = hash_of(name.first) + static_cast<std::uint64_t>(name.second);
    groups_[number % most_groups].add(angles.unpacked());
  };
  const std::pair name(study, replicate);
  if (!groups_.empty()) return combine(name, PackedAngles(histogram));
  each_.emplace(name, histogram);
  if (each_.size() <= most_groups) return;
  groups_.resize(most_groups);
  for (const auto& [own, angles] : each_) combine(own, angles);
  each_.clear();
}

std::vector<PooledAngles::Group> PooledAngles::groups() const {
  std::vector<Group> list = groups_;
  for (const auto& [name, angles] : each_) list.push_back({1, angles.unpacked()});
  std::erase_if(list, [](const Group& group) { return group.replicates == 0; });
  return list;
}

std::optional<PooledTrough> PooledAngles::trough(int particles, const std::string& key) const {
  const auto all = groups();
  if (all.empty()) return std::nullopt;
  Group total;
  std::vector<int> sizes;
  for (const Group& group : all) {
    total.add(group.sum);
    sizes.push_back(group.replicates);
  }
  PooledTrough pooled;
  for (const int size : sizes) pooled.replicates += size;
  pooled.particles = static_cast<double>(particles) * pooled.replicates;
  pooled.cutoffs = trough_cutoffs(total.sum);
  std::array<std::vector<double>, PooledTrough::names.size()> values;
  for (const Group& group : all) {
    const auto [n, C_low, C_high] = trough_numbers(group.sum, particles * group.replicates, pooled.cutoffs);
    if (pooled.cutoffs.has_face_face()) values[0].push_back(n.Z_ff);
    if (!pooled.cutoffs.has_all()) continue;
    const std::array others{n.Z_ef, n.Z_l, n.C, C_low, C_high};
    for (std::size_t i = 0; i < others.size(); ++i) values[i + 1].push_back(others[i]);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].empty()) continue;
    pooled.estimates[i] = groups_.empty() ? estimate(values[i], hash_of(key + std::string(PooledTrough::names[i])))
                                          : estimate_of_groups(values[i], sizes);
  }
  return pooled;
}

}  // namespace isojam
