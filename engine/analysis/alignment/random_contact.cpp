#include "engine/analysis/alignment/random_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Vector3d vector_of(const ConvexSolid& solid, const Edge& edge) {
  return solid.vertices()[static_cast<std::size_t>(edge.head)] - solid.vertices()[static_cast<std::size_t>(edge.tail)];
}

double exterior_angle(const ConvexSolid& solid, const Edge& edge) {
  const Vector3d& left = solid.faces()[static_cast<std::size_t>(edge.left)].normal;
  const Vector3d& right = solid.faces()[static_cast<std::size_t>(edge.right)].normal;
  return nearest::atan2(left.cross(right).norm(), left.dot(right));
}

/// The edges of a solid. at() selects an edge with a probability proportional to ℓ α.
struct Edges {
  explicit Edges(const ConvexSolid& solid) {
    double sum = 0;
    for (const Edge& edge : solid.edges()) {
      const double alpha = exterior_angle(solid, edge);
      sum += vector_of(solid, edge).norm() * alpha;
      up_to.push_back(sum);
      Angle angle;
      angle.half = alpha / 2;
      angle.tangent = nearest::tan(alpha / 4);
      angle.sine = nearest::sin(alpha);
      angle.cosine = nearest::cos(alpha);
      angles.push_back(angle);
    }
    for (double& each : up_to) each /= sum;
  }

  struct Angle {
    double half = 0;              ///< α/2
    double tangent = 0;           ///< tan(α/4)
    double sine = 0, cosine = 0;  ///< sine and cosine of α
  };
  const Angle& at(double x) const {
    const auto found = std::upper_bound(up_to.begin(), up_to.end() - 1, x);
    return angles[static_cast<std::size_t>(found - up_to.begin())];
  }

  double least_half() const { return std::min_element(angles.begin(), angles.end(), by_half)->half; }
  double greatest_half() const { return std::max_element(angles.begin(), angles.end(), by_half)->half; }
  static bool by_half(const Angle& p, const Angle& q) { return p.half < q.half; }

  std::vector<double> up_to;
  std::vector<Angle> angles;
};

/// Angles from the common normal to the normals of the two faces at an edge, as sines and cosines. They are s on one
/// side and α − s on the other side, with s in [0, α/2]. tan(s/2) is proportional to x in [0, 1], so that no elementary
/// function is needed.
struct Tilts {
  Tilts(const Edges::Angle& angle, double x) {
    const double t = angle.tangent * x, square = 1 + squared(t);
    weight = 2 * angle.tangent / square / angle.half;
    const double sine = 2 * t / square, cosine = (1 - squared(t)) / square;
    sines = {sine, sine * angle.cosine - cosine * angle.sine};
    cosines = {cosine, cosine * angle.cosine + sine * angle.sine};
  }

  double least_sine() const { return std::min(sines[0], -sines[1]); }

  double weight = 0;  ///< ds/dx divided by α/2
  std::array<double, 2> sines{}, cosines{};
};

/// The angle ψ in [0, π] between the edges, from tan(ψ/2) = y/(1 − y).
struct Crossing {
  explicit Crossing(double y) {
    const double square = squared(y) + squared(1 - y);
    sine = 2 * y * (1 - y) / square;
    cosine = (1 - 2 * y) / square;
    weight = squared(sine) / square;  // sin²ψ dψ
  }
  double sine = 0, cosine = 0, weight = 0;
};

/// Smallest chord between a normal of A and the negative of a normal of B.
double least_chord(const Tilts& a, const Tilts& b, const Crossing& crossing) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3d normal(a.sines[i], 0, a.cosines[i]);
    for (std::size_t j = 0; j < 2; ++j) {
      const Vector3d other(b.sines[j] * crossing.cosine, b.sines[j] * crossing.sine, b.cosines[j]);
      least = std::min(least, (normal - other).squaredNorm());
    }
  }
  return std::sqrt(least);
}

constexpr int points = 131072;
constexpr std::size_t dimensions = 5;

/// Point k of two sequences that fill a unit cube and a unit square evenly (Roberts 2018). The coordinates are k times
/// the powers of 1/g, with g⁴ = g + 1 for the cube and g³ = g + 1 for the square.
std::array<double, dimensions> even_point(int k) {
  constexpr double of_cube = 1.2207440846057594, of_square = 1.3247179572447460;
  std::array<double, dimensions> x{};
  double step = 1;
  for (std::size_t d = 0; d < dimensions; ++d) {
    step = d == 3 ? 1 / of_square : step / (d < 3 ? of_cube : of_square);
    const double sum = 0.5 + step * k;
    x[d] = sum - std::floor(sum);
  }
  return x;
}

/// Half of the points are even in x and y, for the bulk of the distributions. The coordinates of the other half are
/// fourth powers of even coordinates, for small angles.
struct Place {
  Place(double u, double v, bool small)
      : x(small ? fourth(u) : u), y(small ? fourth(v) : v), weight(2 / (1 + density(x) * density(y))) {}
  static double fourth(double u) { return squared(squared(u)); }
  static double density(double x) { return 1 / (4 * std::sqrt(x) * std::sqrt(std::sqrt(x))); }

  double x, y;
  double weight;  ///< inverse of the density of points
};

/// Mean over all kinds of contacts, weighted by their fractions.
}  // namespace

ContactSize contact_size(const ConvexSolid& solid) {
  ContactSize size;
  for (const Face& face : solid.faces()) {
    Vector3d area = Vector3d::Zero();
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const auto next = face.vertices[(k + 1) % face.vertices.size()];
      area += solid.vertices()[static_cast<std::size_t>(face.vertices[k])].cross(
          solid.vertices()[static_cast<std::size_t>(next)]);
    }
    size.surface += area.dot(face.normal) / 2;
  }
  for (const Edge& edge : solid.edges())
    size.mean_curvature += vector_of(solid, edge).norm() * exterior_angle(solid, edge) / 2;
  return size;
}

ContactShares contact_shares(const ContactSize& a, const ContactSize& b) {
  const double edges = a.mean_curvature * b.mean_curvature / (2 * pi), sum = a.surface + b.surface + edges;
  return {b.surface / sum, a.surface / sum, edges / sum};
}

RandomEdgeContact::RandomEdgeContact(const ConvexSolid& a, const ConvexSolid& b) {
  const Edges edges_a(a), edges_b(b);
  const double cut = std::min(edges_a.least_half(), edges_b.least_half()) / 100;
  const double half_a = edges_a.greatest_half(), half_b = edges_b.greatest_half();
  // The largest angles occur if both contact normals are in the middle of their ranges and the edges cross at a right
  // angle.
  face_face_ = {Curve::By::chord, 2, cut, nearest::acos(nearest::cos(half_a) * nearest::cos(half_b))};
  edge_face_ = {Curve::By::sine, 1, cut, std::min(half_a, half_b)};
  std::vector<Weighted> chords, sines;
  for (int k = 0; k < points; ++k) {
    const auto x = even_point(k);
    const Place place(x[0], x[1], k % 2 == 1);
    const Tilts tilts_a(edges_a.at(x[3]), place.x), tilts_b(edges_b.at(x[4]), place.y);
    const Crossing crossing(x[2]);
    const double weight = place.weight * tilts_a.weight * tilts_b.weight * crossing.weight;
    chords.push_back({least_chord(tilts_a, tilts_b, crossing), weight});
    sines.push_back({crossing.sine * std::min(tilts_a.least_sine(), tilts_b.least_sine()), weight});
  }
  fill(face_face_, std::move(chords));
  fill(edge_face_, std::move(sines));
}

void RandomEdgeContact::fill(Curve& curve, std::vector<Weighted> sample) {
  std::sort(sample.begin(), sample.end(), [](const Weighted& p, const Weighted& q) { return p.at < q.at; });
  double sum = 0;
  for (const Weighted& each : sample) {
    curve.at.push_back(each.at);
    curve.shares.push_back(sum + each.weight / 2);
    sum += each.weight;
  }
  for (double& share : curve.shares) share /= sum;
  curve.share_at_cut = curve.interpolated(curve.cut);
}

double RandomEdgeContact::Curve::measure(double theta) const {
  return by == By::sine ? nearest::sin(theta) : 2 * nearest::sin(theta / 2);
}

double RandomEdgeContact::Curve::interpolated(double theta) const {
  const double x = measure(theta);
  const auto above = std::upper_bound(at.begin(), at.end(), x);
  const auto k = static_cast<std::size_t>(above - at.begin());
  const double left = k == 0 ? 0 : at[k - 1], below = k == 0 ? 0 : shares[k - 1];
  const double right = k == at.size() ? measure(largest) : at[k], beyond = k == at.size() ? 1 : shares[k];
  const double part = right > left ? std::clamp((x - left) / (right - left), 0.0, 1.0) : 1;
  return below + part * (beyond - below);
}

double RandomEdgeContact::Curve::operator()(double theta) const {
  if (theta <= 0) return 0;
  if (theta >= largest) return 1;
  if (theta >= cut) return interpolated(theta);
  const double part = theta / cut;
  return share_at_cut * (power == 2 ? squared(part) : part);
}

RandomContact::RandomContact(const ConvexSolid& solid)
    : vertices_(solid),
      edges_(solid, solid),
      share_(contact_shares(contact_size(solid), contact_size(solid)).edge_edge) {}

double RandomContact::face_face(double theta) const {
  return (1 - share_) * vertices_.face_face(theta) + share_ * edges_.face_face(theta);
}
double RandomContact::edge_face(double theta) const {
  return (1 - share_) * vertices_.edge_face(theta) + share_ * edges_.edge_face(theta);
}

}  // namespace isojam
