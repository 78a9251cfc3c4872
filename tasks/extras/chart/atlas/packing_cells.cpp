#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tasks/extras/chart/atlas/cells.hpp"
#include "tasks/extras/chart/atlas/images.hpp"

namespace isojam {

namespace {

/// Allowed relative error of energies, and error of forces and torques in units of the mean contact force. The contacts
/// are deep, so rounding errors are about 1e-14.
constexpr double tolerance = 1e-12;

constexpr std::array precisions{Precision::working, Precision::double_double};

std::string name_of(Precision precision) {
  return precision == Precision::working ? "contact loop in doubles" : "contact loop in double-double";
}

AtlasRow energy_row(const std::string& regime, const std::string& setting, const Packing& packing) {
  AtlasRow row{regime, setting, "neighbour list", true, {}, {}, {}};
  try {
    const double energy = PackingEnergy().evaluate(packing).energy, exact = energy_over_images(packing);
    return judged(row, std::abs(energy - exact) / exact, tolerance, "relative error of E");
  } catch (const std::invalid_argument& error) {
    row.figure = fmt::format("L = {:.3f}, least {:.3f}", packing.cell.side(), least_side(packing.solids.only()));
    return refused(row, error.what());
  }
}

/// Packings with N = 2 … 8 around a corner of the cell. The side of the cell is slightly larger than the smallest
/// allowed side, equal to it, or so small that a particle touches two images of another one.
void append_smallest_cells(std::vector<AtlasRow>& rows) {
  const ConvexSolid& solid = platonic(SolidKind::tetrahedron);
  const double least = least_side(solid);
  for (int n = 2; n <= 8; ++n) {
    const std::string setting = fmt::format("N = {}", n);
    rows.push_back(energy_row("cell just larger than the least", setting, cornered(n, least * (1 + 1e-12))));
    rows.push_back(energy_row("cell of the least side", setting, cornered(n, least)));
    const Packing small = cornered(n, 0.4 * least);
    rows.push_back(energy_row("cell smaller than the least", setting, small));
    const double exact = energy_over_images(small), nearest = energy_of_nearest_images(small);
    rows.push_back(judged({"cell smaller than the least", setting, "nearest images", false, {}, {}, {}},
                          std::abs(nearest - exact) / exact, tolerance, "relative error of E"));
  }
}

/// A packing, and an equivalent one that must have the same energy. Particle k of `seen` is particle from[k] of
/// `packing`, rotated by `turn`.
struct Twin {
  Packing packing, seen;
  std::vector<int> from;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

Twin twin_of(const Packing& packing) {
  Twin twin{packing, packing, std::vector<int>(packing.poses.size())};
  std::iota(twin.from.begin(), twin.from.end(), 0);
  return twin;
}

/// Largest difference of energy and gradient between the two packings, in units of the energy and the mean force.
double difference(const Twin& twin, Precision precision) {
  const Evaluation a = PackingEnergy().evaluate(twin.packing, precision);
  const Evaluation b = PackingEnergy().evaluate(twin.seen, precision);
  double worst = std::abs(a.energy - b.energy) / a.energy;
  for (int k = 0; k < twin.packing.size(); ++k) {
    for (const int part : {0, 3}) {
      const Eigen::Vector3d expected = twin.turn * a.gradient.segment<3>(6 * twin.from[k] + part);
      worst = std::max(worst, (b.gradient.segment<3>(6 * k + part) - expected).norm() / a.mean_force);
    }
  }
  return worst;
}

Twin translated(const Packing& packing) {
  Twin twin = twin_of(packing);
  const double side = packing.cell.side();
  const Eigen::Vector3d shift = side * Eigen::Vector3d(0.37, -1.61, 0.73);
  for (Pose& pose : twin.seen.poses) {
    pose = moved(pose, shift, Eigen::Vector3d::Zero());
    const Eigen::Vector3i cells = packing.cell.nearest_shift(pose.position);
    pose = moved(pose, side * cells.cast<double>(), Eigen::Vector3d::Zero());
  }
  return twin;
}

/// Particles in another order. In the reverse order, every pair (A, B) becomes (B, A).
Twin relabelled(const Packing& packing, bool reversed) {
  Twin twin = twin_of(packing);
  if (reversed) {
    std::reverse(twin.from.begin(), twin.from.end());
  } else {
    for (int& k : twin.from) k = (7 * k + 3) % packing.size();
  }
  for (std::size_t k = 0; k < twin.from.size(); ++k)
    twin.seen.poses[k] = packing.poses[static_cast<std::size_t>(twin.from[k])];
  return twin;
}

/// The packing rotated by `angle` about the z axis.
Twin turned(const Packing& packing, double angle) {
  Twin twin = twin_of(packing);
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitZ());
  twin.turn = turn.toRotationMatrix();
  for (Pose& pose : twin.seen.poses) {
    Pose next;
    next.position = twin.turn * pose.position;
    next.orientation = Eigen::Quaterniond(turn) * pose.orientation;
    pose = next;
  }
  return twin;
}

/// A twin whose solid was built from vertices in another unit of length. `solid` must outlive the twin.
Twin in_units(const Packing& packing, const ConvexSolid& solid) {
  Twin twin = twin_of(packing);
  twin.seen.solids = solid;
  return twin;
}

ConvexSolid rescaled(const ConvexSolid& solid, double unit) {
  std::vector<Eigen::Vector3d> vertices = solid.vertices();
  for (Eigen::Vector3d& vertex : vertices) vertex *= unit;
  return {solid.name(), vertices};
}

void append_twin(const std::string& regime, const std::string& setting, const Twin& twin, std::vector<AtlasRow>& rows) {
  for (const Precision precision : precisions)
    rows.push_back(judged({regime, setting, name_of(precision), true, {}, {}, {}}, difference(twin, precision),
                          tolerance, "change of E/E, F/mean F"));
}

void append_invariances(std::vector<AtlasRow>& rows) {
  for (const SolidKind kind : all_solids) {
    RandomStream random{42, static_cast<std::uint64_t>(kind)};
    const ConvexSolid& solid = platonic(kind);
    const int n = least_particles(solid, 0.7) + 1;
    Packing packing = random_packing(solid, n % 7 == 0 ? n + 1 : n, 0.7, random);
    const std::string setting(to_string(kind));
    append_twin("translated through the boundary", setting, translated(packing), rows);
    append_twin("relabelled", setting, relabelled(packing, false), rows);
    append_twin("A and B exchanged", setting, relabelled(packing, true), rows);
    append_twin("rotated with the cell by 90°", setting, turned(packing, std::acos(0.0)), rows);
    append_twin("cluster rotated in free space by 1 rad", setting, turned(cluster(kind), 1), rows);
    for (const double unit : {1e-6, 1e6}) {
      const ConvexSolid other = rescaled(solid, unit);
      append_twin("solid given in units of " + decade_name(unit), setting, in_units(packing, other), rows);
    }
  }
}

}  // namespace

std::vector<AtlasRow> packing_atlas() {
  std::vector<AtlasRow> rows;
  append_smallest_cells(rows);
  append_invariances(rows);
  return rows;
}

}  // namespace isojam
