#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/analysis/trough_classes.hpp"
#include "tasks/io/json.hpp"
#include "tasks/tables/statistics.hpp"

namespace isojam {

/// Compact copy of the histogram of the alignment angles of one state. Numbers of contacts are rounded to multiples of
/// 2^−16, so that sums of them are exact and do not depend on their order.
class PackedAngles {
 public:
  explicit PackedAngles(const AngleHistogram& histogram);
  AngleHistogram unpacked() const;

 private:
  /// A number of AngleHistogram: an element of `face_face`, an element of `edge_face_apart`, or a cell. In the first
  /// two cases, the bin of the other angle is `any`.
  struct Entry {
    std::uint8_t face_face, edge_face;
    float contacts;
  };
  static constexpr std::uint8_t any = 255;
  static_assert(angle_bins < any);
  std::vector<Entry> entries_;
  std::uint8_t face_face_window_, edge_face_window_;
};

/// Troughs in the angles of all replicates of a row together, and contact numbers with the cut-offs of these troughs.
/// Single packings often have too few contacts for a trough.
struct PooledTrough {
  int replicates = 0;    ///< number of replicates whose angles are combined
  double particles = 0;  ///< number of particles in all of them together
  TroughCutoffs cutoffs = {};
  /// Names of the estimates in tables, and means over the replicates. Z_ff has a value if θ_ff has a trough. The others
  /// need both troughs.
  static constexpr std::array<std::string_view, 6> names{"Z_ff_pooled", "Z_ef_pooled",  "Z_l_pooled",
                                                         "C_pooled",    "C_pooled_low", "C_pooled_high"};
  std::array<Estimate, 6> estimates = {};
};

/// The angles of the replicates of a row. Up to `most_groups` replicates are stored one by one. More replicates are
/// combined into this number of groups, so that the memory does not grow with the number of replicates.
class PooledAngles {
 public:
  static constexpr std::size_t most_groups = 32;
  /// Adds a replicate. Requires that it was not added before. The result does not depend on the order.
  void add(const std::string& study, int replicate, const AngleHistogram& histogram);
  /// Finds the troughs of all replicates, which have the same number of particles. nullopt if there are no replicates.
  /// `key` is the text from which the random numbers of the bootstrap are derived.
  std::optional<PooledTrough> trough(int particles, const std::string& key) const;

 private:
  struct Group {
    int replicates = 0;
    AngleHistogram sum = {};

    void add(const AngleHistogram& histogram);
  };
  /// The groups that are not empty. If there are few replicates, each of them is a group.
  std::vector<Group> groups() const;

  std::map<std::pair<std::string, int>, PackedAngles> each_;
  std::vector<Group> groups_;  ///< empty if there are few replicates
};

}  // namespace isojam
