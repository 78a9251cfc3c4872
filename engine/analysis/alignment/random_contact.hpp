#pragma once

#include <utility>
#include <vector>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/geometry/convex_solid.hpp"

namespace isojam {

// Two convex solids of random orientations that touch as isotropic ones do: of all places where B can stand and touch
// A, the surface of the Minkowski sum of A and −B, any is as likely. It consists of faces of either, on which a vertex
// of the other lies, and of parallelograms of an edge of each. Over all turns of B its mean area is
// S_A + S_B + M_A M_B/2π, S the surface and M = ½ Σ ℓ α the integral of the mean curvature, over edges of length ℓ and
// exterior angle α (the principal kinematic formula). For RandomAlignment a vertex always touches a face.

/// What weighs a solid's contacts.
struct ContactSize {
  double surface = 0;         ///< S
  double mean_curvature = 0;  ///< M
};
/// Of this solid.
ContactSize contact_size(const ConvexSolid& solid);

/// Shares of all contacts of two solids; their sum is 1.
struct ContactShares {
  double vertex_of_a = 0;  ///< on a face of B
  double vertex_of_b = 0;  ///< on a face of A
  double edge_edge = 0;    ///< edges of both crossed
};
/// Of solids with these sizes, by the mean area of the sum.
ContactShares contact_shares(const ContactSize& a, const ContactSize& b);

/// Distributions of alignment angles where an edge of A touches one of B. Edges are as likely as ℓ α, the common normal
/// stands anywhere between the normals of the two faces at either edge, and the angle ψ between the edges has the
/// density sin²ψ: once for the area of the parallelogram, once for the turns at which two arcs of normals cross
/// (Poincaré).
///   θ_ff: the least angle between a normal of A at its edge and an opposite one of B; c → 4 ⟨1/(α_A α_B)⟩ θ² at 0.
///   θ_ef: sin θ_ef = sin ψ · the least sine of the angles from the common normal to those four.
/// From 131072 fixed points, which is right to 2e-3, and by the law at 0 below a hundredth of the least α/2. Any convex
/// solids; sizes mean nothing.
class RandomEdgeContact {
 public:
  /// Of edges of these two.
  RandomEdgeContact(const ConvexSolid& a, const ConvexSolid& b);

  double face_face(double theta) const { return face_face_(theta); }  ///< distribution of θ_ff
  double edge_face(double theta) const { return edge_face_(theta); }  ///< distribution of θ_ef
  double ff_max() const { return face_face_.largest; }                ///< where face_face reaches 1
  double ef_max() const { return edge_face_.largest; }                ///< where edge_face does

 private:
  /// A distribution by what grows with the angle and needs no inverse function: its sine, or the chord 2 sin(θ/2).
  struct Curve {
    enum class By { sine, chord };
    By by = By::sine;
    int power = 1;                       ///< of θ, at 0
    double cut = 0, largest = 0;         ///< angles: the law at 0 holds below the one, the share is 1 from the other on
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

/// Distributions of the angles of all contacts, a sum of both kinds.
class RandomContact {
 public:
  RandomContact() = default;
  /// Of solids that are all alike.
  explicit RandomContact(const ConvexSolid& solid);

  /// Kinds of contact with their shares of all, which sum to 1.
  void add(double share, RandomAlignment vertices) { vertices_.push_back({share, std::move(vertices)}); }
  void add(double share, RandomEdgeContact edges) { edges_.push_back({share, std::move(edges)}); }

  double face_face(double theta) const;  ///< distribution of θ_ff
  double edge_face(double theta) const;  ///< distribution of θ_ef
  double ff_max() const;                 ///< where face_face reaches 1
  double ef_max() const;                 ///< where edge_face does
  double edge_edge_share() const;        ///< share of contacts that are of two edges

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
