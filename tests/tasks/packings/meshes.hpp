#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace isojam::test {

using Eigen::Vector3d;
using Polygons = std::vector<std::vector<int>>;

/// A polyhedron from which the tests make files.
struct Sample {
  std::vector<Vector3d> points;
  Polygons faces;
};

inline Sample cube() {
  Sample sample;
  for (int k = 0; k < 8; ++k) sample.points.emplace_back(k & 4 ? .5 : -.5, k & 2 ? .5 : -.5, k & 1 ? .5 : -.5);
  sample.faces = {{4, 0, 2, 6}, {1, 0, 4, 5}, {5, 4, 6, 7}, {2, 0, 1, 3}, {6, 2, 3, 7}, {3, 1, 5, 7}};
  return sample;
}

inline Sample tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// The solid with each face divided into triangles around its centre.
inline Sample with_face_centres(const Sample& solid) {
  Sample divided{solid.points, {}};
  for (const auto& face : solid.faces) {
    Vector3d centre = Vector3d::Zero();
    for (const int v : face) centre += solid.points[static_cast<std::size_t>(v)] / static_cast<double>(face.size());
    const auto middle = static_cast<int>(divided.points.size());
    divided.points.push_back(centre);
    for (std::size_t k = 0; k < face.size(); ++k)
      divided.faces.push_back({face[k], face[(k + 1) % face.size()], middle});
  }
  return divided;
}

inline std::string off(const Sample& solid) {
  std::string text = fmt::format("OFF\n{} {} 0\n", solid.points.size(), solid.faces.size());
  for (const auto& p : solid.points) text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& face : solid.faces) text += fmt::format("{} {}\n", face.size(), fmt::join(face, " "));
  return text;
}

using Triangles = std::vector<std::array<Vector3d, 3>>;

inline Triangles triangles(const Sample& solid) {
  Triangles result;
  const auto point = [&](int v) { return solid.points[static_cast<std::size_t>(v)]; };
  for (const auto& face : solid.faces) {
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      result.push_back({point(face[0]), point(face[k]), point(face[k + 1])});
  }
  return result;
}

inline std::string text_stl(const Triangles& list) {
  std::string text = "solid part\n";
  for (const auto& triangle : list) {
    text += " facet normal nan 0 0\n  outer loop\n";
    for (const auto& v : triangle) {
      text += "   vertex";
      for (const double x : v) text += fmt::format(" {}", x);
      text += "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid part\n";
}

inline std::string binary_stl(const Triangles& list) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  put(static_cast<std::uint32_t>(list.size()));
  for (const auto& triangle : list) {
    for (int c = 0; c < 3; ++c) put(0.0F);
    for (const auto& v : triangle) {
      for (const double x : v) put(static_cast<float>(x));
    }
    put(std::uint16_t{0});
  }
  return bytes;
}

/// Triangles whose common corners differ by up to 1e-6 in each coordinate, as some programs write them.
inline Triangles jittered(Triangles list) {
  unsigned state = 7;
  for (auto& triangle : list) {
    for (auto& corner : triangle) {
      for (double& x : corner) {
        state = state * 1664525U + 1013904223U;
        x += 1e-6 * (static_cast<double>(state >> 8) / (1U << 24) - .5);
      }
    }
  }
  return list;
}

}  // namespace isojam::test
