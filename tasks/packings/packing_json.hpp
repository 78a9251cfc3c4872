#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/packing/packing.hpp"
#include "tasks/io/describe.hpp"

namespace isojam {

/// Largest number of particles of a packing that can be read.
inline constexpr std::size_t most_particles = 1000000;

/// A vector is a list of n numbers.
template <int n>
struct kinds::Kind<Eigen::Matrix<double, n, 1>> {
  static MemberRef of(Eigen::Matrix<double, n, 1>& member) {
    auto many = list_of(member);
    many.least = many.most = n;
    return many;
  }
};

struct StoredSolid {
  std::optional<std::string> solid;
  std::optional<std::vector<Eigen::Vector3d>> vertices;
};
void describe(Fields& field, StoredSolid& solid);

/// A packing in a file: its solids and sizes, the density, the cell, and the position and the quaternion (w, x, y, z)
/// of each particle. Each coordinate is stored in double-double; with only the first doubles, a state near jamming
/// would have a residual of about 1e-8.
struct StoredPacking {
  StoredSolid solid;  ///< without values in a mixture
  std::optional<std::vector<StoredSolid>> kinds;
  std::optional<std::vector<int>> kind;
  std::optional<std::vector<double>> size;
  double density = 0;
  std::optional<double> side, side_low;
  std::optional<std::array<Eigen::Vector3d, 3>> cell, cell_low;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector4d> orientations;
  std::vector<Eigen::Vector3d> positions_low;
  std::vector<Eigen::Vector4d> orientations_low;
};
void describe(Fields& field, StoredPacking& packing);
StoredPacking stored(const Packing& packing);
Json to_json(const Packing& packing);

/// Reads a packing with all bits of the original. The object may have other keys. Throws InputError if lists have
/// different lengths, if a number is not allowed, if the squared length of a quaternion is at most 0.5, or if a
/// particle could touch two images of another one in the cell.
Packing read_packing(const JsonPlace& place);

}  // namespace isojam
