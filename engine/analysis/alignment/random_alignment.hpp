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

/// Ideal random contacts of a solid, as a reference for alignment angles (the paper's Figure 2): the solid touches the
/// face of another one. Angles in radians; each function is a distribution function.
///   Unconstrained: all orientations are equally likely, and a vertex touches. Then p(θ_ff) ∝ sin θ_ff up to the angle
///   where the regions of two faces meet, and p(θ_ef) → const at 0.
///   Edge-face constrained: an edge lies in the face; all edges and all rotations about the edge are equally likely.
///   For a regular solid θ_ff is then uniform on [0, π/2 − δ/2], δ the dihedral angle, and θ_ef = 0.
/// Distributions are in closed form if all faces, edges and vertices are equivalent. Otherwise they come from a
/// stratified sample, except for θ_ff below half the smallest angle between two face normals, which has a closed form
/// for any solid.
class RandomAlignment {
 public:
  /// Method to compute distributions.
  enum class Way { closed_where_regular, sampled };
  /// Distributions for contacts of this solid with itself.
  explicit RandomAlignment(const ConvexSolid& solid, Way way = Way::closed_where_regular);

  /// Distribution of θ_ff, the angle from a random direction to the nearest face normal: the fraction of the sphere
  /// within θ of a normal, as caps clipped to the polygons that the faces subtend.
  double face_face(double theta) const;
  /// Distribution of θ_ef, the smallest angle from a random direction to the sides of the polygon that the normal cone
  /// of the vertex forms on the sphere: 1 − the fraction of that polygon farther than θ from all sides, by the
  /// Gauss–Bonnet theorem.
  double edge_face(double theta) const;
  /// Distribution of θ_ff if an edge lies in the face.
  double constrained_face_face(double theta) const;
  /// Distribution of θ_ef in that case: θ_ef is always 0.
  double constrained_edge_face(double theta) const { return theta < 0 ? 0 : 1; }

  double ff_max() const { return ff_max_; }                          ///< angle where face_face reaches 1
  double ef_max() const { return ef_max_; }                          ///< angle where edge_face reaches 1
  double constrained_ff_max() const { return constrained_ff_max_; }  ///< angle where constrained_face_face reaches 1

  /// True if the solid is not regular, so that its distributions come from a sample: n = 65 536 directions, one in each
  /// of n cells of a sphere. The standard deviation of a distribution function is then n^(-3/4) up to a factor near 1.
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

/// Result of comparing angles with random ones.
enum class RandomnessVerdict {
  not_called,
  hyper_random,  ///< significantly more angles near 0 than for random contacts
  random,        ///< no significant difference
  sub_random,    ///< significantly fewer
  too_few        ///< with so few contacts no result would be significant
};
template <>
inline constexpr std::array enum_names<RandomnessVerdict>{
    EnumName{RandomnessVerdict::not_called, "not_called"}, EnumName{RandomnessVerdict::hyper_random, "hyper_random"},
    EnumName{RandomnessVerdict::random, "random"}, EnumName{RandomnessVerdict::sub_random, "sub_random"},
    EnumName{RandomnessVerdict::too_few, "too_few"}};

/// Definitions of "near 0" and of significance.
struct RandomnessOptions {
  double fraction = 0.1;  ///< "near 0" is where the random CDF is below this: so small that the CDF is almost linear
  double level = 0.01;    ///< significance level of the test, on each side
};

/// Number of angles near 0, compared with the expected number for random contacts.
struct Randomness {
  RandomnessVerdict verdict = RandomnessVerdict::not_called;  ///< result of the test
  double angle = 0;                                           ///< end of the range near 0
  long below = 0;                                             ///< number of angles in that range
  double expected = 0;                                        ///< expected number for random contacts
  double probability = 1;  ///< binomial probability of at least or at most this number, the smaller of both
};

/// Compares angles (radians) with `distribution`, one of RandomAlignment, which reaches 1 at `largest`. Throws
/// std::invalid_argument unless fraction and level are between 0 and 1.
Randomness compare_with_random(std::span<const double> angles, const std::function<double(double)>& distribution,
                               double largest, const RandomnessOptions& options = {});

}  // namespace isojam
