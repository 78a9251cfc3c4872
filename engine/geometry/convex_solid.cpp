#include "engine/geometry/convex_solid.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <utility>

#include "engine/geometry/hull.hpp"
#include "engine/geometry/planar_faces.hpp"

namespace isojam {

namespace {

using Loop = FaceLoop;

struct Moments {
  Quad volume = 0;
  Quad3 first{};          ///< ∫ x dV
  Quad second = 0;        ///< ∫ |x|² dV
  QuadMatrix products{};  ///< ∫ x xᵀ dV
};

/// Adds w p pᵀ.
void add_product(Quad w, const Quad3& p, QuadMatrix& sum) {
  for (std::size_t r = 0; r < 3; ++r) sum[r] = sum[r] + w * p[r] * p;
}

Moments moments(const std::vector<Quad3>& points, const std::vector<Loop>& faces) {
  Moments m;
  for (const Loop& face : faces) {
    const Quad3& a = points[face[0]];
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Quad3& b = points[face[k]];
      const Quad3& c = points[face[k + 1]];
      const Quad det = dot(a, cross(b, c));
      const Quad3 s = a + b + c;
      m.volume += det / 6;
      m.first = m.first + det / 24 * s;
      m.second += det / 120 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(s, s));
      for (const Quad3& p : {a, b, c, s}) add_product(det / 120, p, m.products);
    }
  }
  return m;
}

Eigen::Matrix3d inertia_tensor(const Moments& m) {
  Eigen::Matrix3d tensor;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c)
      tensor(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          static_cast<double>((r == c ? m.second : 0) - m.products[r][c]);
  }
  return tensor;
}

/// True if the tensor is a multiple of the identity, within the rounding of vertices given in double.
bool is_isotropic(const Eigen::Matrix3d& tensor) {
  const double mean = tensor.trace() / 3;
  const Eigen::Matrix3d rest = tensor - mean * Eigen::Matrix3d::Identity();
  return rest.cwiseAbs().maxCoeff() <= 64 * std::numeric_limits<double>::epsilon() * mean;
}

/// Edges with tail < head, sorted by (tail, head).
std::vector<Edge> find_edges(const std::vector<Loop>& faces) {
  std::map<std::pair<int, int>, int> left_of;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    const Loop& v = faces[f];
    for (std::size_t k = 0; k < v.size(); ++k) left_of[{v[k], v[(k + 1) % v.size()]}] = f;
  }
  std::vector<Edge> edges;
  for (const auto& [ends, left] : left_of) {
    const auto back = left_of.find({ends.second, ends.first});
    if (back == left_of.end()) throw NoSolid("the faces do not close a convex polyhedron");
    if (ends.first < ends.second) edges.push_back({ends.first, ends.second, left, back->second});
  }
  return edges;
}

double height(const FacePlane& plane, const Loop& face, const Quad3& vertex, int v) {
  if (std::find(face.begin(), face.end(), v) != face.end()) return 0;
  return static_cast<double>(dot(plane.normal, vertex) - plane.offset);
}

void flatten_edges(const std::vector<Edge>& edges, SolidArrays& flat) {
  const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
  const auto place = [](int vertex) {
    return static_cast<std::uint16_t>(SolidArrays::at(static_cast<std::uint32_t>(vertex)));
  };
  flat.edges = static_cast<int>(edges.size());
  const bool in_words = flat.edges <= SolidArrays::word_edges;
  if (in_words) flat.star.resize(static_cast<std::size_t>(flat.vertices));
  for (std::uint32_t k = 0; k < edges.size(); ++k) {
    const Edge& e = edges[k];
    const auto left = static_cast<std::uint32_t>(e.left), right = static_cast<std::uint32_t>(e.right);
    flat.tail.push_back(byte(e.tail)), flat.head.push_back(byte(e.head));
    flat.record.push_back({byte(e.tail),
                           byte(e.head),
                           byte(left),
                           byte(right),
                           place(e.tail),
                           place(e.head),
                           {left << 5 | right << 21, right | left << 16},
                           0});
    if (!in_words) continue;
    Parts<1> edge;
    edge.vertices.insert(flat.tail[k]), edge.vertices.insert(flat.head[k]);
    edge.edges.insert(k);
    edge.faces.insert(left), edge.faces.insert(right);
    flat.record[k].faces = edge.faces.word[0];
    flat.star[flat.tail[k]] |= edge, flat.star[flat.head[k]] |= edge;
  }
  constexpr std::size_t bytes = 16;
  for (auto* ends : {&flat.tail, &flat.head}) ends->resize((edges.size() + bytes - 1) / bytes * bytes, ends->front());
}

SolidArrays flatten(const std::vector<Quad3>& vertices, const std::vector<FacePlane>& planes,
                    const std::vector<Loop>& faces, const std::vector<Edge>& edges) {
  SolidArrays flat;
  flat.vertices = static_cast<int>(vertices.size());
  flat.faces = static_cast<int>(planes.size());
  const auto store = [](Quad value, std::vector<double>& high, std::vector<double>& low) {
    high.push_back(narrowed(value).high);
    low.push_back(narrowed(value).low);
  };
  for (int k = 0; k < (flat.vertices + 3) / 4 * 4; ++k) {
    const Quad3& v = vertices[k < flat.vertices ? k : 0];
    store(v[0], flat.x, flat.x_low), store(v[1], flat.y, flat.y_low), store(v[2], flat.z, flat.z_low);
  }
  const FacePlane nowhere{{}, SolidArrays::far};
  for (int k = 0; k < (flat.faces + 3) / 4 * 4; ++k) {
    const FacePlane& plane = k < flat.faces ? planes[k] : nowhere;
    store(plane.normal[0], flat.nx, flat.nx_low);
    store(plane.normal[1], flat.ny, flat.ny_low);
    store(plane.normal[2], flat.nz, flat.nz_low);
    store(plane.offset, flat.offset, flat.offset_low);
  }
  for (int f = 0; f < flat.faces; ++f) {
    for (int v = 0; v < flat.vertices; ++v) flat.height.push_back(height(planes[f], faces[f], vertices[v], v));
  }
  flatten_edges(edges, flat);
  return flat;
}

/// The points relative to their mean, if the origin is not among them: far from it, volumes of pyramids with their apex
/// at the origin would cancel. The mean is rounded to double, so that no point in double is rounded.
std::vector<Quad3> centred(std::span<const Quad3> vertices) {
  std::vector<Quad3> points(vertices.begin(), vertices.end());
  Quad3 mean = mean_of(points);
  for (Quad& c : mean) c = static_cast<double>(c);
  Quad size = 0;
  for (const Quad3& point : points) size = std::max(size, norm(point - mean));
  if (norm(mean) <= size) return points;
  for (Quad3& point : points) point = point - mean;
  return points;
}

}  // namespace

ConvexSolid::ConvexSolid(std::string name, std::span<const Eigen::Vector3d> vertices)
    : ConvexSolid(std::move(name), widened(vertices)) {
  given_.assign(vertices.begin(), vertices.end());
}

ConvexSolid::ConvexSolid(std::string name, std::span<const Quad3> vertices) : name_(std::move(name)) {
  refuse_large(vertices.size(), {});
  const std::vector<Loop> loops = hull_faces(vertices);
  refuse_large(vertices.size(), loops);
  edges_ = find_edges(loops);
  if (vertices.size() + loops.size() != edges_.size() + 2)
    throw NoSolid("a vertex is not a corner of the convex hull", NoSolid::Cause::not_a_corner);

  std::vector<Quad3> points =
      with_planar_faces(centred(vertices), loops, largest_planar_move * rounding_tolerance(vertices)).vertices;
  const Moments raw = moments(points, loops);
  const Quad3 centroid = (1 / raw.volume) * raw.first;
  const Quad scale = 1 / cube_root(raw.volume);
  for (Quad3& point : points) point = scale * (point - centroid);
  std::vector<FacePlane> planes;
  for (const Loop& loop : loops) planes.push_back(fitted_plane(loop, points));
  for (const Quad3& point : points) {
    vertices_.push_back(rounded(point));
    circumradius_ = std::max(circumradius_, static_cast<double>(norm(point)));
    for (const Quad3& other : points) diameter_ = std::max(diameter_, static_cast<double>(norm(point - other)));
  }
  inradius_ = circumradius_;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    faces_.push_back({rounded(planes[f].normal), static_cast<double>(planes[f].offset), loops[f]});
    inradius_ = std::min(inradius_, faces_.back().offset);
  }
  fine_below_ = edges_.size() <= SolidArrays::narrow_edges ? inradius_ : 4 * circumradius_;
  const Moments about_centroid = moments(points, loops);
  gyration_radius_ = static_cast<double>(square_root(2 * about_centroid.second / 3));
  inertia_ = inertia_tensor(about_centroid);
  is_spherical_top_ = is_isotropic(inertia_);
  arrays_ = flatten(points, planes, loops, edges_);
}

ConvexSolid::ConvexSolid(const ConvexSolid& unit, double scale) : ConvexSolid(unit) {
  assert(unit.scale_ == 1 && scale > 0);
  if (scale == 1) return;
  scale_ = scale;
  std::vector<Quad3> points;
  std::vector<FacePlane> planes;
  std::vector<Loop> loops;
  for (int v = 0; v < arrays_.vertices; ++v) points.push_back(Quad(scale) * arrays_.vertex(v));
  for (int f = 0; f < arrays_.faces; ++f) planes.push_back({arrays_.normal(f), scale * arrays_.plane_offset(f)});
  for (const Face& face : faces_) loops.push_back(face.vertices);
  for (std::size_t v = 0; v < points.size(); ++v) vertices_[v] = rounded(points[v]);
  for (std::size_t f = 0; f < faces_.size(); ++f) faces_[f].offset = static_cast<double>(planes[f].offset);
  for (double* length : {&inradius_, &circumradius_, &diameter_, &gyration_radius_}) *length *= scale;
  inertia_ *= volume() * (scale * scale);
  arrays_ = flatten(points, planes, loops, edges_);
}

}  // namespace isojam
