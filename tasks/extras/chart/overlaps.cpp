#include <fmt/format.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <utility>

#include "engine/geometry/overlap/clipped_overlap.hpp"
#include "engine/geometry/overlap/overlap.hpp"
#include "tasks/extras/chart/comparisons.hpp"
#include "tasks/extras/chart/pairs/intersection.hpp"
#include "tasks/extras/chart/pairs/pair_cases.hpp"

namespace isojam {
namespace {

/// A number with 50 decimal digits.
using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off>;

/// V, and S_A = ∂V/∂x_A: the vector area of the faces of A inside B. If A moves, these faces sweep the gained volume.
template <class T>
struct VolumeAndArea {
  T volume;
  std::array<T, 3> area;
};

template <class T>
VolumeAndArea<T> by_cuts(const PairCase& pair) {
  const ConvexSolid& a = platonic(pair.a);
  const auto body = intersection<T>(a, Pose{}, platonic(pair.b), pair.pose());
  return {body.volume(), body.area_and_moment(a.arrays().faces).first};
}

/// Classes of pairs without coinciding faces, for which the reference would not be valid.
constexpr std::array classes{PairClass::random_contact, PairClass::near_parallel_faces, PairClass::edge_in_face,
                             PairClass::parallel_edges, PairClass::vertex_vertex,       PairClass::same_orientation};

/// An overlap with a larger relative error counts as failed.
constexpr double worst_useful_overlap = 1e-2;

/// A pair, and the data that a packing prepares before it computes overlaps.
struct PreparedPair {
  PairCase pair;
  LonePlacedSolid a, b, double_double_a, double_double_b;
  DoubleDoubleVector displacement;
  QuadPose quad;
  VolumeAndArea<Digits50> right;
};

PreparedPair prepared(const PairCase& pair) {
  const ConvexSolid &a = platonic(pair.a), &b = platonic(pair.b);
  const Pose pose = pair.pose();
  const DoubleDoubleMatrix turn = rotation_matrix(pose);
  DoubleDoubleVector displacement;
  displacement.high = pair.displacement;
  return {pair,
          LonePlacedSolid(a, Eigen::Matrix3d(Eigen::Matrix3d::Identity())),
          LonePlacedSolid(b, turn.high),
          LonePlacedSolid(a, DoubleDoubleMatrix{}),
          LonePlacedSolid(b, turn),
          displacement,
          relative_pose(Pose{}, pose, quad_position(pose)),
          by_cuts<Digits50>(pair)};
}

using Computed = VolumeAndArea<double>;

Computed computed(const Overlap& found) { return {found.volume, {found.area[0], found.area[1], found.area[2]}}; }

Computed in_doubles(const PreparedPair& pair) {
  SeparatingAxis axis;
  return computed(overlap(pair.a, pair.b, pair.pair.displacement, axis));
}

Computed in_double_doubles(const PreparedPair& pair) {
  SeparatingAxis axis;
  return computed(overlap(pair.double_double_a, pair.double_double_b, pair.displacement, axis));
}

Computed by_quadruple_clip(const PreparedPair& pair) {
  return computed(narrowed(clipped_overlap(platonic(pair.pair.a), platonic(pair.pair.b), pair.quad)));
}

Computed by_plain_clip(const PreparedPair& pair) { return by_cuts<double>(pair.pair); }

struct Kernel {
  std::string_view method, setting;
  Computed (*overlap)(const PreparedPair&);
};

constexpr std::array<Kernel, 4> kernels{{{"contact loop in doubles", "double", in_doubles},
                                         {"contact loop in double-double", "two doubles", in_double_doubles},
                                         {"clip in quadruple precision", "quadruple", by_quadruple_clip},
                                         {"clip in doubles", "double", by_plain_clip}}};

double relative_error(double volume, const Digits50& right) {
  return static_cast<double>(Digits50(abs(Digits50(volume) - right) / right));
}

double relative_error(const std::array<double, 3>& area, const std::array<Digits50, 3>& right) {
  Digits50 difference = 0, whole = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Digits50 off = Digits50(area[c]) - right[c];
    difference += off * off;
    whole += right[c] * right[c];
  }
  return std::sqrt(static_cast<double>(Digits50(difference / whole)));
}

void set_errors(const std::vector<PreparedPair>& pairs, const std::vector<Computed>& found, ChartPoint& point) {
  std::vector<double> errors, area_errors;
  int wrong = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    errors.push_back(relative_error(found[k].volume, pairs[k].right.volume));
    wrong += !(errors.back() < worst_useful_overlap);
    area_errors.push_back(relative_error(found[k].area, pairs[k].right.area));
  }
  point.error = spread(errors);
  point.failed = wrong > 0;
  if (point.failed) point.stopped = fmt::format("errors above 1 % in {} of {} pairs", wrong, pairs.size());
  const auto area = spread(area_errors);
  point.further = {{"S_error", area ? Json(area->median) : Json(nullptr)},
                   {"S_error_greatest", area ? Json(area->greatest) : Json(nullptr)}};
}

ChartPoint point_of(const std::string& task, const Kernel& kernel, const std::vector<PreparedPair>& pairs,
                    const Measuring& measuring) {
  ChartPoint point{task,          std::string(kernel.method), std::string(kernel.setting), {}, {}, "done", false,
                   Json::object()};
  std::vector<Computed> found(pairs.size());
  auto seconds = timed(measuring, [&] {
    for (std::size_t k = 0; k < pairs.size(); ++k) found[k] = kernel.overlap(pairs[k]);
  });
  for (double& each : seconds) each /= static_cast<double>(pairs.size());
  point.seconds = spread(seconds);
  set_errors(pairs, found, point);
  return point;
}

}  // namespace

void compare_overlaps(const Measuring& measuring, ChartFamily& family) {
  for (const SolidKind solid : measuring.config.solids) {
    for (const PairClass pair_class : classes) {
      const auto task = fmt::format("{}, {}", to_string(solid), to_string(pair_class));
      if (measuring.over()) return;
      measuring.progress("overlaps, " + task);
      std::vector<PreparedPair> pairs;
      for (const PairCase& pair : pair_cases(solid, solid, pair_class, measuring.config.pairs)) {
        if (measuring.over()) return;
        pairs.push_back(prepared(pair));
      }
      for (const Kernel& kernel : kernels) family.points.push_back(point_of(task, kernel, pairs, measuring));
    }
  }
}

}  // namespace isojam
