#include "tasks/packings/solid_file.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>

#include "tasks/io/file.hpp"

namespace isojam {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

using Eigen::Vector3d;

/// More than any suitable solid has. Reading stops there, so that a file of millions of triangles costs little.
constexpr std::size_t most_faces = 100000;

struct Mesh {
  std::vector<Vector3d> vertices;
  std::vector<std::vector<std::size_t>> faces;
};

/// The words of a text, without comments (from # to the end of a line).
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  std::string_view next() {
    skip();
    const auto end = std::find_if(rest_.begin(), rest_.end(), is_space);
    const auto word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(word.size());
    return word;
  }
  void skip_line() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }
  bool at_end() {
    skip();
    return rest_.empty();
  }

  template <class Number>
  Number number() {
    const auto word = next();
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || word.empty())
      throw NoSolidFile(fmt::format("\"{}\" is not a number", word.substr(0, 20)));
    return value;
  }
  Vector3d vector() {
    const double x = number<double>(), y = number<double>(), z = number<double>();
    return {x, y, z};
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip() {
    for (;;) {
      const auto begin = std::find_if_not(rest_.begin(), rest_.end(), is_space);
      rest_.remove_prefix(static_cast<std::size_t>(begin - rest_.begin()));
      if (!rest_.starts_with('#')) return;
      skip_line();
    }
  }

  std::string_view rest_;
};

std::size_t count_up_to_most(Words& words) {
  const auto count = words.number<std::size_t>();
  if (count > most_faces) throw NoSolidFile(fmt::format("{} vertices or faces are too many", count));
  return count;
}

/// OFF: the keyword, numbers of vertices, faces and edges, coordinates, and faces as lists of vertices. A colour may
/// follow a face on its line.
Mesh read_off(std::string_view text) {
  Words words(text);
  words.next();
  const auto vertices = count_up_to_most(words), faces = count_up_to_most(words);
  words.number<std::size_t>();
  Mesh mesh;
  for (std::size_t k = 0; k < vertices; ++k) mesh.vertices.push_back(words.vector());
  for (std::size_t k = 0; k < faces; ++k) {
    auto& face = mesh.faces.emplace_back();
    for (auto left = count_up_to_most(words); left > 0; --left) {
      face.push_back(words.number<std::size_t>());
      if (face.back() >= vertices)
        throw NoSolidFile(fmt::format("face {} refers to vertex {}, but there are only {}", k, face.back(), vertices));
    }
    words.skip_line();
  }
  return mesh;
}

/// Vertices of triangles; equal coordinates become one vertex.
class Soup {
 public:
  void add(const std::array<Vector3d, 3>& triangle) {
    if (mesh_.faces.size() == most_faces) throw NoSolidFile("there are too many triangles");
    auto& face = mesh_.faces.emplace_back();
    for (const auto& v : triangle) {
      if (!v.allFinite()) throw NoSolidFile("a coordinate is not finite");
      const auto [found, added] = number_.try_emplace({v.x(), v.y(), v.z()}, mesh_.vertices.size());
      if (added) mesh_.vertices.push_back(v);
      face.push_back(found->second);
    }
  }
  Mesh take() { return std::move(mesh_); }

 private:
  Mesh mesh_;
  std::map<std::array<double, 3>, std::size_t> number_;
};

Mesh read_text_stl(std::string_view text) {
  Words words(text);
  Soup soup;
  std::array<Vector3d, 3> triangle;
  std::size_t corner = 0;
  while (!words.at_end()) {
    if (words.next() != "vertex") continue;
    triangle[corner] = words.vector();
    corner = (corner + 1) % 3;
    if (corner == 0) soup.add(triangle);
  }
  if (corner != 0) throw NoSolidFile("a facet has fewer than three vertices");
  return soup.take();
}

constexpr std::size_t stl_head = 84, stl_triangle = 50, stl_normal = 12;

std::uint32_t triangles_of(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + stl_head - sizeof count, sizeof count);
  return count;
}

/// Checks the length against the number of triangles. Binary files may begin with "solid" as text files do.
bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= stl_head && bytes.size() == stl_head + stl_triangle * std::size_t{triangles_of(bytes)};
}

Mesh read_binary_stl(std::string_view bytes) {
  Soup soup;
  for (std::size_t at = stl_head; at < bytes.size(); at += stl_triangle) {
    std::array<float, 9> value{};
    std::memcpy(value.data(), bytes.data() + at + stl_normal, sizeof value);
    soup.add({Vector3d(value[0], value[1], value[2]), Vector3d(value[3], value[4], value[5]),
              Vector3d(value[6], value[7], value[8])});
  }
  return soup.take();
}

Mesh read_mesh(std::string_view bytes) {
  if (is_binary_stl(bytes)) return read_binary_stl(bytes);
  if (bytes.starts_with("OFF")) return read_off(bytes);
  if (bytes.starts_with("solid")) return read_text_stl(bytes);
  throw NoSolidFile("neither an OFF nor an STL file");
}

/// Seven digits, the last of them rounded, and the effect of this error on a plane through three such points at a
/// distance.
constexpr double digits = 1e-5;

void refuse_dents(const Mesh& mesh) {
  double size = 0;
  for (const auto& v : mesh.vertices) size = std::max(size, (v - mesh.vertices.front()).norm());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    Vector3d normal = Vector3d::Zero(), centre = Vector3d::Zero();
    const auto corner = [&](std::size_t k) -> const Vector3d& { return mesh.vertices[face[k % face.size()]]; };
    for (std::size_t k = 0; k < face.size(); ++k) {
      normal += (corner(k) - corner(0)).cross(corner(k + 1) - corner(0));
      centre += corner(k) / static_cast<double>(face.size());
    }
    if (normal.norm() <= digits * size * size) continue;  // a sliver does not define its plane
    normal.normalize();
    double above = 0, below = 0;
    for (const auto& v : mesh.vertices) {
      above = std::max(above, normal.dot(v - centre));
      below = std::max(below, -normal.dot(v - centre));
    }
    if (std::min(above, below) > digits * size)
      throw NoSolidFile(fmt::format("not convex: face {} has vertices on both sides", f));
  }
}

}  // namespace

std::vector<Vector3d> read_solid_file(const std::filesystem::path& path) {
  const auto bytes = read_text(path.string());
  const auto mesh = read_mesh(bytes);
  if (mesh.faces.empty()) throw NoSolidFile("there are no faces");
  for (const auto& v : mesh.vertices) {
    if (!v.allFinite()) throw NoSolidFile("a coordinate is not finite");
  }
  refuse_dents(mesh);
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& face : mesh.faces) {
    for (const auto v : face) used[v] = 1;
  }
  std::vector<Vector3d> vertices;
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (used[k]) vertices.push_back(mesh.vertices[k]);
  }
  return vertices;
}

}  // namespace isojam
