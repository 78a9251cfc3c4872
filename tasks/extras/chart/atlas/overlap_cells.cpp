#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "engine/random/stream.hpp"
#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tasks/extras/chart/atlas/cells.hpp"
#include "tasks/extras/chart/atlas/constructed.hpp"
#include "tasks/extras/chart/pairs/intersection.hpp"

namespace isojam {

namespace {

constexpr std::array depths{1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};
constexpr std::array angles{1e-1, 1e-4, 1e-7, 1e-10, 1e-13, 1e-16, 0.0};

/// Number of orientations and directions in a cell. The cell reports the worst of them.
constexpr int samples = 16;

struct Kernel {
  std::string name;
  bool standard;
  VolumeAndArea (*overlap)(const ConstructedPair&);
};

VolumeAndArea in_double_doubles(const ConstructedPair& pair) {
  const LonePlacedSolid a(platonic(pair.a), rotation_matrix(pair.at_a)),
      b(platonic(pair.b), rotation_matrix(pair.at_b));
  SeparatingAxis unused;
  const Overlap found = overlap(a, b, DoubleDoubleVector{pair.at_b.position, pair.at_b.position_low}, unused);
  return {found.volume, found.area};
}

LonePlacedSolid placed(SolidKind kind, const Pose& pose) {
  return {platonic(kind), pose.orientation.normalized().toRotationMatrix()};
}

VolumeAndArea in_doubles(const ConstructedPair& pair) {
  SeparatingAxis unused;
  const Overlap found = overlap(placed(pair.a, pair.at_a), placed(pair.b, pair.at_b), pair.at_b.position, unused);
  return {found.volume, found.area};
}

/// Cuts A with one plane of B after another. If faces nearly coincide, the result can be wrong.
VolumeAndArea naively(const ConstructedPair& pair) {
  Pose at_a = pair.at_a, at_b = pair.at_b;
  for (Pose* pose : {&at_a, &at_b}) pose->position_low.setZero(), pose->orientation_low.setZero();
  const auto body = intersection<double>(platonic(pair.a), at_a, platonic(pair.b), at_b);
  const auto area = body.area_and_moment(platonic(pair.a).arrays().faces).first;
  return {body.volume(), {area[0], area[1], area[2]}};
}

const std::array<Kernel, 3>& kernels() {
  static const std::array<Kernel, 3> list{Kernel{"contact loop in double-double", true, in_double_doubles},
                                          {"contact loop in doubles", false, in_doubles},
                                          {"plain clip in doubles", false, naively}};
  return list;
}

/// Mean contact force at Δφ = 5e-4, estimated for a vertex in a face at depth δ = Δφ: V = ⅔ δ³ and S = 2 δ². Errors
/// that are much smaller than this force do not affect the balance of forces.
const double weakest_mean_force = 2.0 / 3 * std::pow(5e-4, 5);

/// Relative error of V if its exact value is known in closed form. Otherwise the larger relative error of V and S.
double relative_error(const VolumeAndArea& found, const ConstructedPair& pair) {
  const VolumeAndArea& exact = pair.reference;
  const double volume = std::abs(found.volume - exact.volume) / exact.volume;
  if (pair.closed_form) return volume;
  return std::max(volume, (found.area - exact.area).norm() / exact.area.norm());
}

/// Error of the contact force, in units of weakest_mean_force.
double force_error(const VolumeAndArea& found, const ConstructedPair& pair) {
  const VolumeAndArea& exact = pair.reference;
  return (found.volume * found.area - exact.volume * exact.area).norm() / 2 / weakest_mean_force;
}

/// The cell of one kernel, with the result of its worst pair.
AtlasRow judged_kernel(AtlasRow row, const Kernel& kernel, const std::vector<ConstructedPair>& pairs) {
  double worst = 0, worst_force = 0;
  const auto note = [](double error, double& sum) {
    if (!(error <= sum)) sum = error;  // written so that NaN counts as the worst
  };
  for (const ConstructedPair& pair : pairs) {
    const VolumeAndArea found = kernel.overlap(pair);
    note(relative_error(found, pair), worst);
    note(force_error(found, pair), worst_force);
  }
  row.method = kernel.name, row.standard = kernel.standard;
  const std::string what = pairs.front().closed_form ? "relative error of V" : "relative error of V, S";
  row = judged(row, worst, atlas_overlap_tolerance, what);
  if (row.verdict == AtlasVerdict::fails && worst_force <= atlas_overlap_tolerance) {
    row.verdict = AtlasVerdict::holds;
    row.reason = fmt::format("negligible force: its error is {:.0e} of the mean force at Δφ = 5e-4", worst_force);
  }
  return row;
}

/// A random rotation: no feature is parallel to an axis, and every coordinate is rounded.
QuadQuaternion random_turn(RandomStream& random) {
  QuadQuaternion q;
  for (Quad& component : q) component = random.normal();
  return q;
}

/// Adds a cell for each kernel. It makes `samples` designs and gives each pair a random orientation. The cell has the
/// worst result of these pairs.
void append_cell(const std::string& regime, const std::string& setting,
                 const std::function<PairDesign(int sample, RandomStream&)>& design, std::vector<AtlasRow>& rows) {
  std::vector<ConstructedPair> pairs;
  RandomStream random{20110711};
  for (int k = 0; k < samples; ++k) {
    PairDesign one = design(k, random);
    one.common = random_turn(random);
    pairs.push_back(constructed(one));
  }
  for (const Kernel& kernel : kernels())
    rows.push_back(judged_kernel({regime, setting, {}, false, {}, {}, {}}, kernel, pairs));
}

void append_depths(std::vector<AtlasRow>& rows) {
  constexpr std::array<std::pair<const char*, ContactShape>, 4> shapes{
      std::pair{"depth, face on face", ContactShape::faces},
      {"depth, edge on face", ContactShape::edge_on_face},
      {"depth, edge across edge", ContactShape::edge_across_edge},
      {"depth, vertex on face", ContactShape::vertex_on_face}};
  for (const auto& [name, shape] : shapes) {
    for (const double depth : depths)
      append_cell(
          name, decade_name(depth), [kind = shape, depth](int, RandomStream&) { return contact_design(kind, depth); },
          rows);
  }
  for (const double depth : depths)
    append_cell(
        "depth, vertex on vertex", decade_name(depth), [&](int, RandomStream&) { return tip_to_tip(depth); }, rows);
}

void append_tilts(std::vector<AtlasRow>& rows) {
  for (const double angle : angles) {
    const std::string setting = decade_name(angle);
    append_cell(
        "faces parallel to, 1e-3 deep", setting, [&](int, RandomStream&) { return tilted_faces(1e-3, angle); }, rows);
    append_cell(
        "faces parallel to, 1e-11 deep", setting, [&](int, RandomStream&) { return tilted_faces(1e-11, angle); }, rows);
    append_cell(
        "edges parallel to, 1e-3 deep", setting, [&](int, RandomStream&) { return tilted_edges(1e-3, angle); }, rows);
  }
}

Eigen::Vector3d direction(RandomStream& random) {
  Eigen::Vector3d u;
  for (double& component : u) component = random.normal();
  return u.normalized();
}

/// Pairs of solids with the same orientation. One displacement is arbitrary. The other is parallel to a face, so that
/// two pairs of faces are coplanar.
void append_same_orientation(std::vector<AtlasRow>& rows) {
  constexpr std::array lengths{1e-1, 1e-4, 1e-7, 1e-10, 1e-13, 1e-16, 0.0};
  for (const double length : lengths) {
    append_cell(
        "same orientation, apart by", length == 0 ? "0" : decade_name(length),
        [&](int k, RandomStream& random) {
          const SolidKind kind = k % 2 == 0 ? SolidKind::cube : SolidKind::tetrahedron;
          return displaced(kind, length * direction(random));
        },
        rows);
  }
  for (const double length : lengths) {
    if (length == 0) continue;
    append_cell(
        "same orientation, faces coplanar, apart by", decade_name(length),
        [&](int k, RandomStream& random) {
          const SolidKind kind = k % 2 == 0 ? SolidKind::cube : SolidKind::tetrahedron;
          const Eigen::Vector3d n = platonic(kind).faces()[0].normal;
          return displaced(kind, length * n.cross(direction(random)));
        },
        rows);
  }
}

void append_coincident(std::vector<AtlasRow>& rows) {
  for (const SolidKind kind : all_solids) {
    append_cell(
        "coincident", std::string(to_string(kind)),
        [&](int, RandomStream&) {
          PairDesign design = displaced(kind, Eigen::Vector3d::Zero());
          design.volume = 1;
          return design;
        },
        rows);
  }
}

void append_generic(std::vector<AtlasRow>& rows) {
  for (const SolidKind kind : all_solids) {
    append_cell(
        "no difficulty", std::string(to_string(kind)),
        [&](int, RandomStream& random) {
          PairDesign design = displaced(kind, platonic(kind).inradius() * direction(random));
          design.turn_b = random_turn(random);
          design.volume.reset();
          return design;
        },
        rows);
  }
}

/// A solid of half the size inside another one. isojam scales all solids to unit volume, so none of its pairs is of
/// this kind. The plain clip uses only planes and can compute such a pair.
void append_inside(std::vector<AtlasRow>& rows) {
  std::vector<Eigen::Vector3d> halved = platonic(SolidKind::cube).vertices();
  for (Eigen::Vector3d& vertex : halved) vertex /= 2;
  const ConvexSolid solid("halved", halved);
  const double size = solid.circumradius() / platonic(SolidKind::cube).circumradius();
  AtlasRow row{"one inside another", "half the size", kernels()[0].name, true, {}, {}, {}};
  row.figure = fmt::format("size 0.5 on input, {:.3f} after scaling", size);
  rows.push_back(refused(row, "solids are scaled to unit volume, so none fits inside another"));
  RelativePose pose{Eigen::Matrix3d::Identity() / 2, {0.125, 0.0625, 0}};
  const double volume = clipped_overlap(platonic(SolidKind::cube), platonic(SolidKind::cube), pose).volume;
  rows.push_back(judged({"one inside another", "half the size", "clip in quadruple precision", true, {}, {}, {}},
                        std::abs(volume - 0.125) / 0.125, atlas_overlap_tolerance, "relative error of V"));
}

}  // namespace

std::vector<AtlasRow> overlap_atlas() {
  std::vector<AtlasRow> rows;
  append_generic(rows);
  append_depths(rows);
  append_tilts(rows);
  append_same_orientation(rows);
  append_coincident(rows);
  append_inside(rows);
  return rows;
}

}  // namespace isojam
