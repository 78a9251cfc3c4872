#include "engine/analysis/alignment/random_alignment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/analysis/alignment/critical_angles.hpp"
#include "engine/arithmetic/distributions.hpp"
#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

double angle_between(const Vector3d& u, const Vector3d& v) { return nearest::atan2(u.cross(v).norm(), u.dot(v)); }

/// Number of intervals of both cylindrical coordinates of the sphere. The sample has one direction in each of bands²
/// cells of equal area.
constexpr int bands = 256;

Vector3d direction_at(double z, double azimuth) {
  const double r = std::sqrt(1 - z * z);
  return {r * nearest::cos(azimuth), r * nearest::sin(azimuth), z};
}

/// Fraction of ascending values below x, interpolated linearly between the values; 0 at x = 0.
double share_below(const std::vector<double>& values, double x) {
  const auto above = std::lower_bound(values.begin(), values.end(), x);
  if (above == values.end()) return 1;
  const auto below = static_cast<double>(above - values.begin());
  const double left = above == values.begin() ? 0 : *(above - 1);
  const double part = *above > left ? (x - left) / (*above - left) : 0;
  return std::min(1.0, (below + part) / static_cast<double>(values.size()));
}

/// Position of the element with the largest value; the first of them if there are several.
template <class Range, class Value>
auto greatest(const Range& range, const Value& value) {
  auto best = range.begin();
  double most = value(*best);
  for (auto it = best; it != range.end(); ++it) {
    const double here = value(*it);
    if (here <= most) continue;
    most = here;
    best = it;
  }
  return best;
}

/// Directions of the features of a solid, which are computed once for all directions of a sample.
class Features {
 public:
  explicit Features(const ConvexSolid& solid) : solid_(solid), edges_at_(solid.vertices().size()) {
    for (const Edge& edge : solid.edges()) {
      for (const int end : {edge.tail, edge.head}) edges_at_[static_cast<std::size_t>(end)].push_back(edges_.size());
      edges_.push_back((solid.vertices()[edge.head] - solid.vertices()[edge.tail]).normalized());
    }
  }

  /// The direction that is reached from one face normal at an edge by the fraction `part` of the rotation to the other
  /// face normal. If the edge lies in a face, it can rotate only in this range.
  Vector3d turned_about(std::size_t e, double part) const {
    const Edge& edge = solid_.edges()[e];
    const Vector3d& left = solid_.faces()[static_cast<std::size_t>(edge.left)].normal;
    const Vector3d& right = solid_.faces()[static_cast<std::size_t>(edge.right)].normal;
    const double sense = left.cross(right).dot(edges_[e]) < 0 ? -1 : 1;
    const double angle = sense * (part * angle_between(left, right));
    // Rodrigues' formula for an axis perpendicular to the rotated vector.
    return nearest::cos(angle) * left + nearest::sin(angle) * edges_[e].cross(left);
  }

  double nearest_normal(const Vector3d& direction) const {
    const Face& nearest = *greatest(solid_.faces(), [&](const Face& face) { return face.normal.dot(direction); });
    return angle_between(nearest.normal, direction);
  }

  /// Smallest elevation, above a plane with the normal `direction`, of the edges that meet in the outermost vertex.
  double least_elevation(const Vector3d& direction) const {
    const auto outermost = greatest(solid_.vertices(), [&](const Vector3d& vertex) { return vertex.dot(direction); });
    double least = 1;
    for (const std::size_t edge : edges_at_[static_cast<std::size_t>(outermost - solid_.vertices().begin())])
      least = std::min(least, std::abs(edges_[edge].dot(direction)));
    return nearest::asin(least);
  }

 private:
  const ConvexSolid& solid_;
  std::vector<Vector3d> edges_;
  std::vector<std::vector<std::size_t>> edges_at_;  ///< edges that meet in each vertex
};

}  // namespace

RandomAlignment::RandomAlignment(const ConvexSolid& solid, Way way)
    : faces_(static_cast<double>(solid.faces().size())), vertices_(static_cast<double>(solid.vertices().size())) {
  if (way == Way::sampled || !set_regular(solid)) sample(solid);
}

/// Sets the closed form. Returns false if the faces, edges and vertices do not all have the same angles. Otherwise 2E/V
/// edges meet in each vertex.
bool RandomAlignment::set_regular(const ConvexSolid& solid) {
  if (!has_like_features(solid)) return false;
  const CriticalAngles critical = critical_angles(solid);
  face_sides_ = static_cast<double>(solid.faces().front().vertices.size());
  valence_ = 2 * static_cast<double>(solid.edges().size()) / vertices_;
  ff_max_ = critical.ff_vertex_face;
  ef_max_ = critical.ef_vertex_face;
  constrained_ff_max_ = critical.ff_edge_face;
  return true;
}

void RandomAlignment::sample(const ConvexSolid& solid) {
  const Features features(solid);
  RandomStream random{solid.faces().size(), solid.edges().size(), solid.vertices().size()};
  for (int band = 0; band < bands; ++band) {
    for (int sector = 0; sector < bands; ++sector) {
      const double z = 2 * (band + random.uniform()) / bands - 1;
      const Vector3d direction = direction_at(z, 2 * pi * (sector + random.uniform()) / bands);
      face_face_.push_back(features.nearest_normal(direction));
      edge_face_.push_back(features.least_elevation(direction));
    }
  }
  for (std::size_t edge = 0; edge < solid.edges().size(); ++edge) {
    for (int k = 0; k < bands; ++k)
      constrained_.push_back(features.nearest_normal(features.turned_about(edge, (k + .5) / bands)));
  }
  for (auto* list : {&face_face_, &edge_face_, &constrained_}) std::sort(list->begin(), list->end());
  ff_max_ = face_face_.back();
  ef_max_ = edge_face_.back();
  constrained_ff_max_ = constrained_.back();
  caps_apart_ = pi;
  for (const Face& face : solid.faces()) {
    for (const Face& other : solid.faces()) {
      if (&face != &other) caps_apart_ = std::min(caps_apart_, angle_between(face.normal, other.normal) / 2);
    }
  }
}

double RandomAlignment::face_face(double theta) const {
  if (theta <= 0) return 0;
  if (theta >= ff_max_) return 1;
  if (is_sampled()) {
    if (theta <= caps_apart_) return faces_ * squared(nearest::sin(theta / 2));
    return share_below(face_face_, theta);
  }
  const double inradius = constrained_ff_max_;  // inradius of the polygon that a face subtends
  if (theta <= inradius) return faces_ * squared(nearest::sin(theta / 2));
  // At the azimuth ψ about the normal from the middle of a side, the side is at the angle ρ, tan ρ = tan(inradius)/cos
  // ψ. For ψ within `cut` it is nearer than θ, and ∫ (1 − cos ρ) dψ = ψ − arcsin(cos(inradius) sin ψ).
  const double cut = nearest::acos(nearest::tan(inradius) / nearest::tan(theta));
  const double inside = cut - nearest::asin(nearest::cos(inradius) * nearest::sin(cut));
  const double cap = (pi / face_sides_ - cut) * 2 * squared(nearest::sin(theta / 2));
  return std::min(1.0, faces_ * face_sides_ / (2 * pi) * (inside + cap));
}

// Area of the polygon of a normal cone that is farther than θ from all sides. With the axis of the vertex along z, the
// sides of the polygon are perpendicular to the edges. The edges have unit vectors e_k = (cos β cos 2πk/q, cos β sin
// 2πk/q, sin β) towards the vertex, with β = ef_max. Points n that are farther than θ from every side satisfy n·e_k >
// sin θ. The region of these points is bounded by q arcs of circles about e_k. An arc has the geodesic curvature tan θ
// and the length φ cos θ, and two arcs meet at the exterior angle ε. The area is 2π − q(φ sin θ + ε).
double RandomAlignment::cone_beyond(double theta) const {
  const double half = pi / valence_, sine = nearest::sin(ef_max_), cosine = nearest::cos(ef_max_);
  const Vector3d first(cosine, 0, sine);
  const Vector3d second(cosine * nearest::cos(2 * half), cosine * nearest::sin(2 * half), sine);
  // The corner between them is at the colatitude ρ: cos ρ sin β − sin ρ cos β cos(π/q) = sin θ.
  const double slope = cosine * nearest::cos(half), radius = nearest::hypot(sine, slope);
  const double rho = nearest::acos(std::min(1.0, nearest::sin(theta) / radius)) - nearest::atan2(slope, sine);
  const Vector3d corner(-nearest::sin(rho) * nearest::cos(half), -nearest::sin(rho) * nearest::sin(half),
                        nearest::cos(rho));
  const double phi = 2 * nearest::atan2(std::abs(corner.y()), corner.dot(Vector3d(-sine, 0, cosine)));
  const double exterior = angle_between(first.cross(corner), second.cross(corner));
  return 2 * pi - valence_ * (phi * nearest::sin(theta) + exterior);
}

double RandomAlignment::edge_face(double theta) const {
  if (theta <= 0) return 0;
  if (theta >= ef_max_) return 1;
  if (is_sampled()) return share_below(edge_face_, theta);
  return std::clamp(1 - cone_beyond(theta) * vertices_ / (4 * pi), 0.0, 1.0);
}

double RandomAlignment::constrained_face_face(double theta) const {
  if (theta <= 0) return 0;
  if (is_sampled()) return share_below(constrained_, theta);
  return std::clamp(theta / constrained_ff_max_, 0.0, 1.0);
}

Randomness compare_with_random(std::span<const double> angles, const std::function<double(double)>& distribution,
                               double largest, const RandomnessOptions& options) {
  const auto proper = [](double part) { return part > 0 && part < 1; };
  if (!proper(options.fraction) || !proper(options.level))
    throw std::invalid_argument("fraction and level of a comparison with random contacts must be between 0 and 1");
  const auto n = static_cast<long>(angles.size());
  double low = 0, high = largest;
  while (low + (high - low) / 2 > low && low + (high - low) / 2 < high) {
    const double middle = low + (high - low) / 2;
    (distribution(middle) < options.fraction ? low : high) = middle;
  }
  Randomness result;
  result.angle = high;
  result.below = std::count_if(angles.begin(), angles.end(), [&](double angle) { return angle < high; });
  result.expected = options.fraction * static_cast<double>(n);
  const BinomialTails tails = binomial_tails(n, options.fraction, result.below);
  result.probability = std::min({1.0, tails.at_least, tails.at_most});
  if (nearest::pow(options.fraction, static_cast<double>(n)) > options.level) {
    result.verdict = RandomnessVerdict::too_few;
  } else if (result.probability > options.level) {
    result.verdict = RandomnessVerdict::random;
  } else {
    result.verdict = tails.at_least < tails.at_most ? RandomnessVerdict::hyper_random : RandomnessVerdict::sub_random;
  }
  return result;
}

}  // namespace isojam
