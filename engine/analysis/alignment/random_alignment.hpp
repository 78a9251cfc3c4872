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

/// Ideal random contacts of a solid, to compare alignment angles with (the paper's Figure 2): the solid touches the
/// face of another. Angles in radians; each function is a distribution function.
///   Unconstrained: any orientation is as likely, and a vertex touches. Then p(θ_ff) ∝ sin θ_ff up to where the regions
///   of two faces meet, and p(θ_ef) → const at 0. Edge-face constrained: an edge lies in the face, any of them turned
///   about itself by any angle as likely. Then θ_ff of a regular solid is uniform on [0, π/2 − δ/2], δ the dihedral
///   angle, and θ_ef = 0.
/// In closed form where faces, edges and vertices are all alike; otherwise from a stratified sample, but for θ_ff below
/// half the least angle between two face normals, which is in closed form for any solid.
class RandomAlignment {
 public:
  /// How distributions are found.
  enum class Way { closed_where_regular, sampled };
  /// Of contacts of this solid with itself.
  explicit RandomAlignment(const ConvexSolid& solid, Way way = Way::closed_where_regular);

  /// Distribution of θ_ff, the angle from a random direction to the nearest face normal: the part of the sphere within
  /// θ of one, caps cut to the polygons that the faces subtend.
  double face_face(double theta) const;
  /// Distribution of θ_ef, the least angle from a random direction to the sides of the polygon that the vertex's normal
  /// cone cuts out of the sphere: 1 − the part of that polygon farther than θ from all sides, by Gauss and Bonnet.
  double edge_face(double theta) const;
  /// The distribution of θ_ff where an edge lies in the face.
  double constrained_face_face(double theta) const;
  /// That of θ_ef, which is 0.
  double constrained_edge_face(double theta) const { return theta < 0 ? 0 : 1; }

  double ff_max() const { return ff_max_; }                          ///< where face_face reaches 1
  double ef_max() const { return ef_max_; }                          ///< where edge_face does
  double constrained_ff_max() const { return constrained_ff_max_; }  ///< where constrained_face_face does

  /// Whether the solid is not regular, and its distributions are those of a sample: n = 65 536 directions, one in each
  /// of n cells of a sphere. Then n^(-3/4) is the standard deviation of a distribution function but for a factor
  /// near 1.
  bool is_sampled() const { return !face_face_.empty(); }

 private:
  double cone_beyond(double theta) const;
  bool set_regular(const ConvexSolid& solid);
  void sample(const ConvexSolid& solid);

  double faces_ = 0, vertices_ = 0, face_sides_ = 0, valence_ = 0;
  double ff_max_ = 0, ef_max_ = 0, constrained_ff_max_ = 0;
  double caps_apart_ = 0;                                    ///< half the least angle between two face normals
  std::vector<double> face_face_, edge_face_, constrained_;  ///< ascending; empty in closed form
};

/// How angles compare with random ones.
enum class RandomnessVerdict {
  not_called,
  hyper_random,  ///< more angles near 0 than random contacts would have
  random,        ///< as many, to within chance
  sub_random,    ///< fewer
  too_few        ///< no outcome of so few contacts would be unlikely
};
template <>
inline constexpr std::array enum_names<RandomnessVerdict>{
    EnumName{RandomnessVerdict::not_called, "not_called"}, EnumName{RandomnessVerdict::hyper_random, "hyper_random"},
    EnumName{RandomnessVerdict::random, "random"}, EnumName{RandomnessVerdict::sub_random, "sub_random"},
    EnumName{RandomnessVerdict::too_few, "too_few"}};

/// What counts as near 0, and as chance.
struct RandomnessOptions {
  double fraction = 0.1;  ///< "near 0" is where the random CDF stays below this: few enough that its curve is straight
  double level = 0.01;    ///< of the test, on each side
};

/// How many angles are near 0, against how many random contacts would have there.
struct Randomness {
  RandomnessVerdict verdict = RandomnessVerdict::not_called;  ///< what the test says
  double angle = 0;                                           ///< end of the range near 0
  long below = 0;                                             ///< angles there
  double expected = 0;                                        ///< of random contacts
  double probability = 1;  ///< of at least so many (hyper-random) or at most so many, binomial, the smaller of both
};

/// Compares angles (radians) with `distribution`, one of RandomAlignment, which reaches 1 at `largest`. Throws
/// std::invalid_argument unless fraction and level lie between 0 and 1.
Randomness compare_with_random(std::span<const double> angles, const std::function<double(double)>& distribution,
                               double largest, const RandomnessOptions& options = {});

}  // namespace isojam
