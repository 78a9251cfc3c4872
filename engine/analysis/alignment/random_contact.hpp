#pragma once

#include <algorithm>
#include <vector>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/geometry/convex_solid.hpp"

namespace isojam {

// Model of random contacts of two convex solids A and B with random orientations: all positions in which B touches A
// are equally likely. These positions form the surface of the Minkowski sum of A and −B. The surface has faces of two
// types. The first type are faces of A or B; there, a vertex of the other solid lies on the face. The second type are
// parallelograms that an edge of A and an edge of B span; there, the two edges cross. The mean area of the surface,
// over all rotations of B, is S_A + S_B + M_A M_B/2π (principal kinematic formula). S is the surface area of a solid,
// and M = ½ Σ ℓ α is its integrated mean curvature. The sum is over the edges of the solid with length ℓ and exterior
// angle α. In RandomAlignment, in contrast, edges never cross.

/// Quantities of a solid that determine the frequency of each type of contact.
struct ContactSize {
  double surface = 0;         ///< surface area S
  double mean_curvature = 0;  ///< integrated mean curvature M
};
/// Computes S and M of a solid.
ContactSize contact_size(const ConvexSolid& solid);

/// Fractions of the types of contacts between solids A and B. Their sum is 1.
struct ContactShares {
  double vertex_of_a = 0;  ///< a vertex of A is on a face of B
  double vertex_of_b = 0;  ///< a vertex of B is on a face of A
  double edge_edge = 0;    ///< an edge of A crosses an edge of B
};
/// Computes the fractions from the mean areas of the faces of the Minkowski sum.
ContactShares contact_shares(const ContactSize& a, const ContactSize& b);

/// Distributions of alignment angles of contacts in which an edge of A crosses an edge of B. The probability of an edge
/// is proportional to ℓ α. Four normals belong to such a contact: the normals of the two faces at the edge of A, and of
/// the two faces at the edge of B. The directions between the two normals at an edge form an arc. The direction of the
/// common normal of both edges is uniformly distributed on the arc of A and on the arc of B. The angle ψ between the
/// edges has the density sin²ψ: one factor sin ψ for the area of the parallelogram, and one for the rotations in which
/// the two arcs cross (Poincaré).
///   θ_ff   smallest angle between a normal of A and the negative of a normal of B. Its cumulative distribution is
///          4 ⟨1/(α_A α_B)⟩ θ² for θ → 0, where ⟨ ⟩ is the mean over the edges.
///   θ_ef   sin θ_ef = sin ψ · (smallest sine of an angle between the common normal and one of the four normals)
/// The distributions are computed from 131072 fixed points with an error of 2e-3. Below a hundredth of the smallest
/// α/2, the limiting law for θ → 0 is used. The distributions apply to any convex solids, and do not depend on the
/// sizes of the solids.
class RandomEdgeContact {
 public:
  /// Computes the distributions for an edge of `a` and an edge of `b`.
  RandomEdgeContact(const ConvexSolid& a, const ConvexSolid& b);

  double face_face(double theta) const { return face_face_(theta); }  ///< cumulative distribution of θ_ff
  double edge_face(double theta) const { return edge_face_(theta); }  ///< cumulative distribution of θ_ef
  double ff_max() const { return face_face_.largest; }                ///< angle where face_face() reaches 1
  double ef_max() const { return edge_face_.largest; }                ///< angle where edge_face() reaches 1

 private:
  /// A distribution, stored as a function of the sine of the angle or of the chord 2 sin(θ/2). Both increase with the
  /// angle, and both are obtained without an inverse trigonometric function.
  struct Curve {
    enum class By { sine, chord };
    By by = By::sine;
    int power = 1;                ///< power of θ in the law for θ → 0
    double cut = 0, largest = 0;  ///< the law for θ → 0 applies below `cut`; the distribution is 1 from `largest` on
    std::vector<double> at{}, shares{};  ///< values of the sine or chord, ascending, and of the distribution
    double share_at_cut = 0;

    double measure(double theta) const;
    double interpolated(double theta) const;
    double operator()(double theta) const;
  };
  struct Weighted {
    double at, weight;
  };
  static void fill(Curve& curve, std::vector<Weighted> sample);

  Curve face_face_, edge_face_;
};

/// Distributions of the alignment angles of all contacts between identical solids: the sum of the distributions of both
/// types of contacts, weighted by their fractions.
class RandomContact {
 public:
  explicit RandomContact(const ConvexSolid& solid);

  double face_face(double theta) const;                                            ///< cumulative distribution of θ_ff
  double edge_face(double theta) const;                                            ///< cumulative distribution of θ_ef
  double ff_max() const { return std::max(vertices_.ff_max(), edges_.ff_max()); }  ///< where face_face() reaches 1
  double ef_max() const { return std::max(vertices_.ef_max(), edges_.ef_max()); }  ///< where edge_face() reaches 1
  double edge_edge_share() const { return share_; }  ///< fraction of contacts in which two edges cross

 private:
  RandomAlignment vertices_;
  RandomEdgeContact edges_;
  double share_;
};

}  // namespace isojam
