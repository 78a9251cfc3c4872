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

/// Distributions of the alignment angles for ideal random contacts, as a reference (the paper's Figure 2). In these
/// contacts, a solid touches the face of another one. Angles are in radians; each function is a cumulative
/// distribution. There are two cases:
///   Unconstrained: all orientations are equally likely, and a vertex touches. Then p(θ_ff) ∝ sin θ_ff up to the angle
///   where the regions of two faces meet, and p(θ_ef) → const at 0.
///   Edge-face constrained: an edge lies in the face; all edges and all rotations about the edge are equally likely.
///   For a regular solid θ_ff is then uniform on [0, π/2 − δ/2], δ the dihedral angle, and θ_ef = 0.
/// If all faces, edges and vertices of the solid are equivalent, the distributions have a closed form. Otherwise they
/// are computed from a stratified sample. For any solid, θ_ff has a closed form below half of the smallest angle
/// between two face normals.
class RandomAlignment {
 public:
  /// Method to compute the distributions.
  enum class Way { closed_where_regular, sampled };
  /// Computes the distributions for contacts between particles with this solid.
  explicit RandomAlignment(const ConvexSolid& solid, Way way = Way::closed_where_regular);

  /// Distribution of θ_ff, the angle between a random direction and the nearest face normal. It is the fraction of the
  /// sphere that is within θ of a normal. This area consists of spherical caps that are clipped by the spherical
  /// polygons of the faces.
  double face_face(double theta) const;
  /// Distribution of θ_ef, the smallest angle from a random direction to the sides of the polygon that the normal cone
  /// of the vertex forms on the sphere: 1 − the fraction of that polygon farther than θ from all sides, by the
  /// Gauss–Bonnet theorem.
  double edge_face(double theta) const;
  /// Distribution of θ_ff for the case that an edge lies in the face.
  double constrained_face_face(double theta) const;
  /// Distribution of θ_ef for the case that an edge lies in the face; θ_ef is then always 0.
  double constrained_edge_face(double theta) const { return theta < 0 ? 0 : 1; }

  double ff_max() const { return ff_max_; }                          ///< angle where face_face reaches 1
  double ef_max() const { return ef_max_; }                          ///< angle where edge_face reaches 1
  double constrained_ff_max() const { return constrained_ff_max_; }  ///< angle where constrained_face_face reaches 1

  /// True if the solid is not regular, so that the distributions are computed from a sample. The sample consists of n =
  /// 65 536 directions, one in each of n cells of the sphere. The standard deviation of a distribution is then
  /// n^(-3/4), times a factor near 1.
  bool is_sampled() const { return !face_face_.empty(); }

 private:
  double cone_beyond(double theta) const;
  bool set_regular(const ConvexSolid& solid);
  void sample(const ConvexSolid& solid);

  double faces_ = 0, vertices_ = 0, face_sides_ = 0, valence_ = 0;
  double ff_max_ = 0, ef_max_ = 0, constrained_ff_max_ = 0;
  double caps_apart_ = 0;                                    ///< half the smallest angle between two face normals
  std::vector<double> face_face_, edge_face_, constrained_;  ///< ascending; empty in closed form
};

/// Result of a comparison of angles with those of random contacts.
enum class RandomnessVerdict {
  not_called,
  hyper_random,  ///< there are significantly more angles near 0 than for random contacts
  random,        ///< there is no significant difference
  sub_random,    ///< there are significantly fewer angles near 0 than for random contacts
  too_few        ///< there are so few contacts that no result would be significant
};
template <>
inline constexpr std::array enum_names<RandomnessVerdict>{
    EnumName{RandomnessVerdict::not_called, "not_called"}, EnumName{RandomnessVerdict::hyper_random, "hyper_random"},
    EnumName{RandomnessVerdict::random, "random"}, EnumName{RandomnessVerdict::sub_random, "sub_random"},
    EnumName{RandomnessVerdict::too_few, "too_few"}};

/// Parameters: the definition of angles near 0, and the level of significance.
struct RandomnessOptions {
  double fraction = 0.1;  ///< angles are near 0 where the random distribution is below this; there it is almost linear
  double level = 0.01;    ///< significance level of each side of the test
};

/// Comparison of the number of angles near 0 with the expected number for random contacts.
struct Randomness {
  RandomnessVerdict verdict = RandomnessVerdict::not_called;  ///< result of the test
  double angle = 0;                                           ///< upper end of the range near 0, radians
  long below = 0;                                             ///< number of angles in this range
  double expected = 0;                                        ///< expected number for random contacts
  /// binomial probability of at least this number, or of at most this number of angles; the smaller of both
  double probability = 1;
};

/// Compares angles (radians) with a distribution of RandomAlignment, which reaches 1 at `largest`. Throws
/// std::invalid_argument unless `fraction` and `level` are between 0 and 1.
Randomness compare_with_random(std::span<const double> angles, const std::function<double(double)>& distribution,
                               double largest, const RandomnessOptions& options = {});

}  // namespace isojam
