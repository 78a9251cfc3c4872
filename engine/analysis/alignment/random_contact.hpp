#pragma once

#include <utility>
#include <vector>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/geometry/convex_solid.hpp"

namespace isojam {

// Model of random contacts of two convex solids A and B with random orientations: all positions in which B touches A
// are equally likely. These positions form the surface of the Minkowski sum of A and −B. This surface consists of two
// kinds of faces: faces of A or B, on which a vertex of the other solid lies, and parallelograms, which an edge of A
// and an edge of B span. The mean area of the surface, over all rotations of B, is S_A + S_B + M_A M_B/2π (principal
// kinematic formula). S is the surface area of a solid. M = ½ Σ ℓ α is its integral of the mean curvature, with the sum
// over the edges of length ℓ and exterior angle α. In RandomAlignment, in contrast, a vertex always touches a face.

/// Quantities of a solid that determine how often it has contacts of each type.
struct ContactSize {
  double surface = 0;         ///< S
  double mean_curvature = 0;  ///< M
};
/// Computes the quantities of a solid.
ContactSize contact_size(const ConvexSolid& solid);

/// Fractions of the types of contacts of two solids. Their sum is 1.
struct ContactShares {
  double vertex_of_a = 0;  ///< vertex of A on a face of B
  double vertex_of_b = 0;  ///< vertex of B on a face of A
  double edge_edge = 0;    ///< an edge of A crosses an edge of B
};
/// Computes the fractions from the mean area of the Minkowski sum.
ContactShares contact_shares(const ContactSize& a, const ContactSize& b);

/// Distributions of alignment angles if an edge of A touches an edge of B. The probability of an edge is proportional
/// to ℓ α. The common normal is uniform between the normals of the two faces at either edge. The angle ψ between the
/// edges has the density sin²ψ: one factor for the area of the parallelogram, one for the rotations in which two arcs
/// of normals cross (Poincaré).
///   θ_ff: the smallest angle between a normal of A at its edge and an opposite one of B; c → 4 ⟨1/(α_A α_B)⟩ θ² at 0.
///   θ_ef: sin θ_ef = sin ψ · the smallest sine of the angles from the common normal to those four.
/// Computed from 131072 fixed points with an error of 2e-3; below a hundredth of the smallest α/2 the limiting law at 0
/// is used. Applies to any convex solids, independent of their sizes.
class RandomEdgeContact {
 public:
  /// Distributions for edges of these two solids.
  RandomEdgeContact(const ConvexSolid& a, const ConvexSolid& b);

  double face_face(double theta) const { return face_face_(theta); }  ///< distribution of θ_ff
  double edge_face(double theta) const { return edge_face_(theta); }  ///< distribution of θ_ef
  double ff_max() const { return face_face_.largest; }                ///< angle where face_face reaches 1
  double ef_max() const { return edge_face_.largest; }                ///< angle where edge_face reaches 1

 private:
  /// A distribution stored as a function of a quantity that increases with the angle and needs no inverse function: the
  /// sine, or the chord 2 sin(θ/2).
  struct Curve {
    enum class By { sine, chord };
    By by = By::sine;
    int power = 1;                       ///< power of θ near 0
    double cut = 0, largest = 0;         ///< below `cut` the law at 0 applies; from `largest` on the fraction is 1
    std::vector<double> at{}, shares{};  ///< ascending
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

/// Distributions of the angles of all contacts: the sum of both kinds, weighted by their fractions.
class RandomContact {
 public:
  RandomContact() = default;
  /// Contacts of identical solids.
  explicit RandomContact(const ConvexSolid& solid);

  /// Add a kind of contact with its fraction of all contacts; the fractions must sum to 1.
  void add(double share, RandomAlignment vertices) { vertices_.push_back({share, std::move(vertices)}); }
  void add(double share, RandomEdgeContact edges) { edges_.push_back({share, std::move(edges)}); }

  double face_face(double theta) const;  ///< distribution of θ_ff
  double edge_face(double theta) const;  ///< distribution of θ_ef
  double ff_max() const;                 ///< angle where face_face reaches 1
  double ef_max() const;                 ///< angle where edge_face reaches 1
  double edge_edge_share() const;        ///< fraction of contacts between two edges

 private:
  template <class Angles>
  struct Part {
    double share;
    Angles angles;
  };
  std::vector<Part<RandomAlignment>> vertices_;
  std::vector<Part<RandomEdgeContact>> edges_;
};

}  // namespace isojam
