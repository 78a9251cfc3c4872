#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "engine/geometry/overlap.hpp"
#include "tasks/chart/comparisons.hpp"
#include "tasks/chart/pairs/precise_volume.hpp"

namespace isojam {
namespace {

using oracle::PairCase;
using oracle::PairClass;

/// Those in which no two faces coincide: see precise_volume().
constexpr std::array classes{PairClass::random_contact, PairClass::near_parallel_faces, PairClass::edge_in_face,
                             PairClass::parallel_edges, PairClass::vertex_vertex,       PairClass::same_orientation};

/// Beyond this an answer is wrong, not inaccurate.
constexpr double worst_useful_error = 1e-2;

/// A pair with what a packing has at hand before it asks for the overlap.
struct PreparedPair {
  PairCase pair;
  Pose pose;  ///< of B; A stands at the origin
  PlacedSolid a, b, precise_a, precise_b;
  TwoDoubleVector displacement;
  QuadPose quad;
  oracle::Precise volume;
};

PreparedPair prepared(const PairCase& pair) {
  const ConvexSolid &a = platonic(pair.a), &b = platonic(pair.b);
  Pose pose;
  pose.position = pair.displacement;
  pose.orientation = pair.quaternion;
  const TwoDoubleMatrix turn = rotation_matrix(pose);
  TwoDoubleVector displacement;
  displacement.high = pair.displacement;
  return {pair,
          pose,
          PlacedSolid(a, Eigen::Matrix3d(Eigen::Matrix3d::Identity())),
          PlacedSolid(b, turn.high),
          PlacedSolid(a, TwoDoubleMatrix{}),
          PlacedSolid(b, turn),
          displacement,
          relative_pose(Pose{}, pose, quad_position(pose)),
          oracle::precise_volume(pair)};
}

double in_doubles(const PreparedPair& pair) {
  SeparatingAxis axis;
  return overlap(pair.a, pair.b, pair.pair.displacement, axis).volume;
}

double in_two_doubles(const PreparedPair& pair) {
  SeparatingAxis axis;
  return overlap(pair.precise_a, pair.precise_b, pair.displacement, axis).volume;
}

double by_quadruple_clip(const PreparedPair& pair) {
  return narrowed(clipped_overlap(platonic(pair.pair.a), platonic(pair.pair.b), pair.quad)).volume;
}

double by_plain_clip(const PreparedPair& pair) { return oracle::rough_volume(pair.pair); }

struct Kernel {
  std::string_view method, setting;
  double (*volume)(const PreparedPair&);
};

constexpr std::array<Kernel, 4> kernels{{{"contact loop in doubles", "double", in_doubles},
                                         {"contact loop in two doubles", "two doubles", in_two_doubles},
                                         {"clip in quadruple precision", "quadruple", by_quadruple_clip},
                                         {"clip in doubles", "double", by_plain_clip}}};

double relative_error(double volume, const oracle::Precise& right) {
  return static_cast<double>(oracle::Precise(abs(oracle::Precise(volume) - right) / right));
}

ChartPoint point_of(const std::string& task, const Kernel& kernel, const std::vector<PreparedPair>& pairs,
                    const Measuring& measuring) {
  ChartPoint point{task,          std::string(kernel.method), std::string(kernel.setting), {}, {}, "done", false,
                   Json::object()};
  std::vector<double> volumes(pairs.size());
  auto seconds = timed(measuring, [&] {
    for (std::size_t k = 0; k < pairs.size(); ++k) volumes[k] = kernel.volume(pairs[k]);
  });
  for (double& each : seconds) each /= static_cast<double>(pairs.size());
  std::vector<double> errors;
  int wrong = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    errors.push_back(relative_error(volumes[k], pairs[k].volume));
    wrong += !(errors.back() < worst_useful_error);
  }
  point.seconds = spread(seconds);
  point.error = spread(errors);
  point.failed = wrong > 0;
  if (point.failed) point.stopped = fmt::format("wrong by 1 % and more in {} of {} pairs", wrong, pairs.size());
  return point;
}

}  // namespace

void compare_overlaps(const Measuring& measuring, ChartFamily& family) {
  for (const SolidKind solid : measuring.config.solids) {
    for (const PairClass pair_class : classes) {
      const auto task = fmt::format("{}, {}", to_string(solid), to_string(pair_class));
      measuring.console.tick("overlaps, " + task);
      std::vector<PreparedPair> pairs;
      for (const PairCase& pair : oracle::pair_cases(solid, solid, pair_class, measuring.config.pairs)) {
        if (measuring.over()) return;
        pairs.push_back(prepared(pair));
      }
      for (const Kernel& kernel : kernels) family.points.push_back(point_of(task, kernel, pairs, measuring));
    }
  }
}

}  // namespace isojam
