#include "tests/oracle/exact_solid.hpp"

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

namespace isojam::oracle {

namespace {

/// The nearest multiple of 2^-200, with an error below 1e-60. Exact arithmetic is faster with short numbers.
Rational shortened(const Real& value) { return to_rational(ldexp(round(ldexp(value, 200)), -200)); }

/// Adds (±x, ±y, ±z) with every combination of signs. A coordinate that is zero gets only one sign.
void add_signs(std::vector<RationalVector>& points, const RationalVector& p) {
  for (int signs = 0; signs < 8; ++signs) {
    RationalVector v = p;
    bool repeated = false;
    for (int k = 0; k < 3; ++k) {
      if (!(signs >> k & 1)) continue;
      repeated = repeated || v[k] == 0;
      v[k] = -v[k];
    }
    if (!repeated) points.push_back(v);
  }
}

void add_cyclic(std::vector<RationalVector>& points, const Rational& x, const Rational& y, const Rational& z) {
  add_signs(points, {x, y, z});
  add_signs(points, {y, z, x});
  add_signs(points, {z, x, y});
}

struct ClosedForm {
  std::vector<RationalVector> vertices;
  Real volume;
};

/// Coordinates and volume as in textbooks. The golden ratio g is replaced by a rational approximation. All faces are
/// still exactly planar: triangles and squares are planar for any g, and the pentagons of (±1, ±1, ±1), (0, ±(1−h²),
/// ±(1+h)) are planar for every h = g − 1.
ClosedForm closed_form(SolidKind kind) {
  const Real root5 = sqrt(Real(5));
  const Real g = (1 + root5) / 2;
  const Rational one(1), zero(0), h = shortened(g - 1);
  ClosedForm form;
  switch (kind) {
    case SolidKind::tetrahedron:
      form.vertices = {{one, one, one}, {one, -one, -one}, {-one, one, -one}, {-one, -one, one}};
      form.volume = Real(8) / 3;
      break;
    case SolidKind::cube:
      add_signs(form.vertices, {one, one, one});
      form.volume = 8;
      break;
    case SolidKind::octahedron:
      add_cyclic(form.vertices, one, zero, zero);
      form.volume = Real(4) / 3;
      break;
    case SolidKind::dodecahedron:
      add_signs(form.vertices, {one, one, one});
      add_cyclic(form.vertices, zero, one - h * h, one + h);
      form.volume = (15 + 7 * root5) / 4 * pow(2 / g, 3);
      break;
    case SolidKind::icosahedron:
      add_cyclic(form.vertices, zero, one, one + h);
      form.volume = 5 * (3 + root5) / 12 * 8;
      break;
  }
  const Rational scale = shortened(1 / cbrt(form.volume));
  for (RationalVector& v : form.vertices) v = {scale * v[0], scale * v[1], scale * v[2]};
  return form;
}

/// The exact vertices in the order of the engine's vertices, so that features have the same indices.
std::vector<RationalVector> snapped(SolidKind kind, const std::vector<RationalVector>& exact) {
  const std::vector<Eigen::Vector3d>& given = platonic(kind).vertices();
  if (given.size() != exact.size()) throw std::logic_error("vertex count of " + std::string(to_string(kind)));
  std::vector<RationalVector> result;
  for (const Eigen::Vector3d& v : given) {
    for (const RationalVector& e : exact) {
      const Eigen::Vector3d candidate(CGAL::to_double(e[0]), CGAL::to_double(e[1]), CGAL::to_double(e[2]));
      if ((candidate - v).lpNorm<Eigen::Infinity>() < 1e-14) result.push_back(e);
    }
  }
  if (result.size() != exact.size()) {
    throw std::logic_error("vertices of the " + std::string(to_string(kind)) + " are not its closed form to 1e-14");
  }
  return result;
}

ExactSolid build(SolidKind kind) {
  ExactSolid solid;
  solid.vertices = snapped(kind, closed_form(kind).vertices);
  solid.edges = platonic(kind).edges();
  solid.vertex_planes.assign(solid.vertices.size(), 0);
  for (const Face& face : platonic(kind).faces()) {
    const RationalVector& a = solid.vertices[face.vertices[0]];
    const RationalVector normal = cross(solid.vertices[face.vertices[1]] - a, solid.vertices[face.vertices[2]] - a);
    const RationalPlane plane{normal, dot(normal, a)};
    std::size_t on_plane = 0;
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
      const Rational side = dot(plane.normal, solid.vertices[v]) - plane.offset;
      if (side > 0) throw std::logic_error("a vertex of the exact solid lies outside one of its faces");
      if (side != 0) continue;
      solid.vertex_planes[v] |= 1U << solid.planes.size();
      ++on_plane;
    }
    if (on_plane != face.vertices.size()) throw std::logic_error("a face of the exact solid is not planar");
    solid.planes.push_back(plane);
    solid.faces.push_back(face.vertices);
  }
  return solid;
}

}  // namespace

Rational to_rational(const Real& value) {
  Rational result(0);
  mpfr_get_q(result.get_mpq_t(), value.backend().data());
  return result;
}

Real to_real(const Rational& value) {
  Real result(0);
  mpfr_set_q(result.backend().data(), value.get_mpq_t(), MPFR_RNDN);
  return result;
}

Rational dot(const RationalVector& u, const RationalVector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

RationalVector cross(const RationalVector& u, const RationalVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

RationalVector operator+(const RationalVector& u, const RationalVector& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}

RationalVector operator-(const RationalVector& u, const RationalVector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}

RationalVector operator*(const RationalMatrix& m, const RationalVector& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

RationalMatrix rotation_matrix(const RealQuaternion& q) {
  const Rational w = to_rational(q.w()), x = to_rational(q.x()), y = to_rational(q.y()), z = to_rational(q.z());
  const Rational norm2 = w * w + x * x + y * y + z * z;
  if (norm2 == 0) throw std::invalid_argument("rotation by a zero quaternion");
  const Rational s = 2 / norm2;
  return {RationalVector{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
          RationalVector{s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
          RationalVector{s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
}

const ExactSolid& exact_solid(SolidKind kind) {
  static const std::array<ExactSolid, all_solids.size()> solids = [] {
    std::array<ExactSolid, all_solids.size()> all;
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = build(all_solids[k]);
    return all;
  }();
  return solids[static_cast<std::size_t>(kind)];
}

ExactSolid moved(const ExactSolid& solid, const RationalMatrix& rotation, const RationalVector& displacement) {
  ExactSolid result = solid;
  for (RationalVector& v : result.vertices) v = rotation * v + displacement;
  for (RationalPlane& plane : result.planes) {
    plane.normal = rotation * plane.normal;
    plane.offset += dot(plane.normal, displacement);
  }
  return result;
}

}  // namespace isojam::oracle
