#include "tasks/packings/foreign_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "tasks/packings/similarity.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

/// Relative tolerance of a size: rounding of single precision and of a shape's vertices.
constexpr double size_tolerance = 1e-3;
/// Limits image counts, so that they stay far from the range of int.
constexpr double most_cells = 1e6;

/// Assigns a type of the file to one of a mixture's solids.
struct Match {
  const ConvexSolid* solid = nullptr;
  Similarity place;  ///< placement of the solid in the body frame of the type
};

std::optional<Match> match_of(const ForeignPacking::Type& type, const Mixture& mixture) {
  for (const auto& kind : mixture.kinds()) {
    const ConvexSolid& solid = *kind.solid;
    if (type.vertices.empty()) {
      if (solid.name() == type.name) return Match{&solid, {}};
    } else if (const auto found = similarity(solid, type.vertices)) {
      return Match{&solid, *found};
    }
  }
  return std::nullopt;
}

std::vector<Match> matches_of(const ForeignPacking& foreign, const Mixture& mixture) {
  std::vector<Match> matches;
  for (std::size_t t = 0; t < foreign.types.size(); ++t) {
    const auto used = std::any_of(foreign.bodies.begin(), foreign.bodies.end(),
                                  [&](const auto& body) { return body.type == static_cast<int>(t); });
    const auto match = match_of(foreign.types[t], mixture);
    if (used && !match)
      throw NoPackingFile(
          fmt::format("particles of type \"{}\" do not match {}", foreign.types[t].name, to_string(mixture)));
    matches.push_back(match.value_or(Match{}));
  }
  return matches;
}

/// The mixture's particles in the order of the file's particles. Sizes of one solid are assigned in order of size.
std::vector<Particle> assigned(const Mixture& mixture, const std::vector<Particle>& in_file) {
  auto own = mixture.particles(static_cast<int>(in_file.size()));
  const auto before = [](const Particle& a, const Particle& b) {
    return std::pair(a.unit->name(), a.scale) < std::pair(b.unit->name(), b.scale);
  };
  std::stable_sort(own.begin(), own.end(), before);
  std::vector<std::size_t> order(in_file.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return before(in_file[a], in_file[b]); });
  auto result = in_file;
  for (std::size_t k = 0; k < order.size(); ++k) {
    auto& particle = result[order[k]];
    if (particle.unit != own[k].unit || !(std::abs(particle.scale - own[k].scale) <= size_tolerance * own[k].scale))
      throw NoPackingFile(fmt::format(
          "its {} particles do not match {}: one is a {} of size {:.6g} instead of a {} of size {:.6g}", in_file.size(),
          to_string(mixture), particle.unit->name(), particle.scale, own[k].unit->name(), own[k].scale));
    particle = own[k];
  }
  return result;
}

PeriodicCell cell_of(const Eigen::Matrix3d& vectors) {
  const double side = vectors(0, 0);
  const Eigen::Matrix3d cube = side * Eigen::Matrix3d::Identity();
  // In single precision the sides of a cube may differ by rounding, and tilts of 0 may become small numbers.
  if ((vectors - cube).cwiseAbs().maxCoeff() <= 1e-6 * std::abs(side)) return PeriodicCell(side);
  DoubleDoubleMatrix cell;
  cell.high = vectors;
  return PeriodicCell(cell);
}

}  // namespace

Packing packing_of(const ForeignPacking& foreign, const Mixture& mixture) {
  const auto matches = matches_of(foreign, mixture);
  std::vector<Particle> particles;
  double volume = 0;
  for (const auto& body : foreign.bodies) {
    const auto& match = matches[static_cast<std::size_t>(body.type)];
    particles.push_back({match.solid, body.size * match.place.scale});
    volume += cubed(particles.back().scale);
  }
  const double unit = nearest::cbrt(volume / static_cast<double>(particles.size()));
  if (!std::isfinite(unit) || !(unit > 0)) throw NoPackingFile("the sizes of its particles overflow or underflow");
  for (auto& particle : particles) particle.scale /= unit;
  try {
    Packing packing{Composition(assigned(mixture, particles)), cell_of(foreign.cell / unit), {}};
    for (const auto& body : foreign.bodies) {
      const auto& place = matches[static_cast<std::size_t>(body.type)].place;
      Pose pose;
      pose.position = (body.position + body.orientation * (body.size * place.shift)) / unit;
      pose.orientation = (body.orientation * place.rotation).normalized();
      // Written so that NaN is refused too.
      if (!(packing.cell.fractional(pose.position).cwiseAbs().maxCoeff() <= most_cells))
        throw NoPackingFile(
            fmt::format("particle {} is more than {} cells away from the origin", packing.size(), most_cells));
      packing.poses.push_back(pose);
    }
    return packing;
  } catch (const std::invalid_argument& error) {
    throw NoPackingFile(fmt::format("its cell is not valid: {}", error.what()));
  }
}

}  // namespace isojam
