#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/names/enum_names.hpp"
#include "engine/random/stream.hpp"

namespace isojam {

/// Cumulative distributions of the alignment angles of ideal random contacts, as a reference (the paper's Figure 2). In
/// these contacts, a solid touches a face of another solid. Angles are in radians, and p is a probability density.
/// There are two models:
///   unconstrained          All orientations are equally likely, so a vertex touches the face. p(θ_ff) ∝ sin θ_ff below
///                          half of the smallest angle between two face normals. p(θ_ef) is finite for θ_ef → 0.
///   edge-face constrained  An edge lies in the face. All edges and all rotations about the edge are equally likely,
///                          and θ_ef = 0. For a regular solid with dihedral angle δ, θ_ff is uniform on [0, π/2 − δ/2].
/// If all faces, edges and vertices of the solid are equivalent, the distributions have a closed form. Otherwise they
/// are computed from a stratified sample. Only the distribution of θ_ff below half of the smallest angle between two
/// face normals then also has a closed form.
class RandomAlignment {
 public:
  /// Method to compute the distributions.
  enum class Way { closed_where_regular, sampled };
  /// Computes the distributions for contacts between particles with this solid.
  explicit RandomAlignment(const ConvexSolid& solid, Way way = Way::closed_where_regular);

  /// Distribution of θ_ff, the angle between a random direction and the nearest face normal. It is the fraction of the
  /// unit sphere that is within θ of a normal. This area consists of spherical caps around the normals. For a regular
  /// solid, each cap is clipped by the spherical polygon that its face subtends.
  double face_face(double theta) const;
  /// Distribution of θ_ef. The outward normals of all planes that touch the solid only at one vertex form a polygon on
  /// the unit sphere, the normal cone. θ_ef is the smallest angle from a random direction to the sides of the polygon
  /// that contains this direction. The distribution is 1 minus the fraction of the polygon that is farther than θ from
  /// all sides. The Gauss–Bonnet theorem gives this fraction.
  double edge_face(double theta) const;
  /// Distribution of θ_ff in the edge-face constrained model.
  double constrained_face_face(double theta) const;
  /// Distribution of θ_ef in the edge-face constrained model, where θ_ef is always 0.
  double constrained_edge_face(double theta) const { return theta < 0 ? 0 : 1; }

  double ff_max() const { return ff_max_; }  ///< angle where face_face() reaches 1
  double ef_max() const { return ef_max_; }  ///< angle where edge_face() reaches 1
  /// angle where constrained_face_face() reaches 1
  double constrained_ff_max() const { return constrained_ff_max_; }

  /// True if the distributions are computed from a sample: the solid is not regular, or Way::sampled was requested. The
  /// sample consists of n = 65 536 directions, one in each of n parts of the sphere with equal areas. The standard
  /// deviation of a distribution is then about n^(-3/4). The constrained model uses 256 rotations about each edge.
  bool is_sampled() const { return !face_face_.empty(); }

 private:
  double cone_beyond(double theta) const;
  bool set_regular(const ConvexSolid& solid);
  void sample(const ConvexSolid& solid);

  double faces_ = 0, vertices_ = 0, face_sides_ = 0, valence_ = 0;
  double ff_max_ = 0, ef_max_ = 0, constrained_ff_max_ = 0;
  double caps_apart_ = 0;  ///< half of the smallest angle between two face normals
  /// sampled angles, ascending; empty if the distributions have a closed form
  std::vector<double> face_face_, edge_face_, constrained_;
};

/// Result of a comparison of alignment angles with the angles of random contacts.
enum class RandomnessVerdict {
  not_called,
  hyper_random,  ///< there are significantly more angles near 0 than for random contacts
  random,        ///< there is no significant difference
  sub_random,    ///< there are significantly fewer angles near 0 than for random contacts
  too_few        ///< there are so few contacts that no number of angles near 0 would be significant
};
template <>
inline constexpr std::array enum_names<RandomnessVerdict>{
    EnumName{RandomnessVerdict::not_called, "not_called"}, EnumName{RandomnessVerdict::hyper_random, "hyper_random"},
    EnumName{RandomnessVerdict::random, "random"}, EnumName{RandomnessVerdict::sub_random, "sub_random"},
    EnumName{RandomnessVerdict::too_few, "too_few"}};

/// Options of compare_with_random().
struct RandomnessOptions {
  /// an angle counts as near 0 if the distribution for random contacts is below this value at this angle
  double fraction = 0.1;
  double level = 0.01;  ///< significance level for each side of the test
};

/// Comparison of the number of angles near 0 with the number that is expected for random contacts.
struct Randomness {
  RandomnessVerdict verdict = RandomnessVerdict::not_called;  ///< result of the test
  double angle = 0;                                           ///< upper end of the range of angles near 0, in radians
  long below = 0;                                             ///< number of angles in this range
  double expected = 0;  ///< number of angles that random contacts would have in this range
  /// for random contacts, the smaller of two binomial probabilities: that at least `below` angles are in this range,
  /// and that at most `below` angles are
  double probability = 1;
};

/// Compares angles (radians) with a distribution for random contacts, which reaches 1 at `largest`. Throws
/// std::invalid_argument unless `fraction` and `level` are between 0 and 1.
Randomness compare_with_random(std::span<const double> angles, const std::function<double(double)>& distribution,
                               double largest, const RandomnessOptions& options = {});

}  // namespace isojam
