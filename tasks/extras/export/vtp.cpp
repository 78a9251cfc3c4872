#include <fmt/format.h>

#include "tasks/extras/export/formats.hpp"
#include "tasks/extras/export/vtk_xml.hpp"

namespace isojam {
namespace {

constexpr auto explanation =
    "<!-- particle: number from 0. Z: contacts of the particle. cluster: smallest number of a particle in the same "
    "cluster of face-face contacts; -1: no face-face contact, -2: classes of contacts undecided. contact_class: the "
    "highest class of a contact of this face; 3: face-face, 2: edge-face, 1: lower-order, 0: no contact, -1: contacts "
    "with undecided classes. Lengths are in units of V_p^(1/3). -->\n";

std::vector<double> world_vertices(const Packing& packing) {
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const auto& pose = packing.poses[i];
    const Eigen::Matrix3d rotation = rotation_matrix(pose).high;
    const auto centre = into_cell(packing.cell, pose.position).wrapped;
    for (const auto& vertex : packing.solids[i].vertices()) {
      const Eigen::Vector3d corner = centre + rotation * vertex;
      coordinates.insert(coordinates.end(), corner.begin(), corner.end());
    }
  }
  return coordinates;
}

/// Vertex numbers of all polygons, one polygon after another, and the position at which each polygon ends.
struct Polygons {
  std::vector<std::size_t> corners, ends;
};

Polygons polygons_of(const Packing& packing) {
  Polygons polygons;
  std::size_t first = 0;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const auto& solid = packing.solids[i];
    for (const auto& face : solid.faces()) {
      for (const int vertex : face.vertices) polygons.corners.push_back(first + static_cast<std::size_t>(vertex));
      polygons.ends.push_back(polygons.corners.size());
    }
    first += solid.vertices().size();
  }
  return polygons;
}

void append_cell_data(std::string& xml, const ExportFrame& frame) {
  std::vector<std::size_t> particle;
  for (std::size_t i = 0; i + 1 < frame.first_face.size(); ++i)
    particle.insert(particle.end(), frame.first_face[i + 1] - frame.first_face[i], i);
  const auto per_line = frame.solid(0).faces().size();
  const auto append = [&](std::string_view name, const auto& of_face) {
    append_array(xml, "Int32", fmt::format("Name=\"{}\"", name), frame.faces.size(), per_line, of_face);
  };
  xml += "<CellData Scalars=\"contact_class\">\n";
  append("particle", [&](std::size_t f) { return particle[f]; });
  append("Z", [&](std::size_t f) { return frame.Z[particle[f]]; });
  append("cluster", [&](std::size_t f) { return frame.cluster[particle[f]]; });
  append("contact_class", [&](std::size_t f) { return static_cast<std::int32_t>(frame.faces[f]); });
  xml += "</CellData>\n";
}

void append_geometry(std::string& xml, const Packing& packing) {
  const auto points = world_vertices(packing);
  const auto polygons = polygons_of(packing);
  xml += "<Points>\n";
  append_array(xml, "Float64", "Name=\"Points\" NumberOfComponents=\"3\"", points.size(), 3,
               [&](std::size_t k) { return points[k]; });
  xml += "</Points>\n<Polys>\n";
  append_array(xml, "Int64", "Name=\"connectivity\"", polygons.corners.size(), 24,
               [&](std::size_t k) { return polygons.corners[k]; });
  append_array(xml, "Int64", "Name=\"offsets\"", polygons.ends.size(), 24,
               [&](std::size_t k) { return polygons.ends[k]; });
  xml += "</Polys>\n";
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

}  // namespace

std::string vtp_file(const ExportFrame& frame) {
  const auto& packing = frame.packing;
  auto xml = vtk_head(frame, explanation);
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) vertices += packing.solids[i].vertices().size();
  fmt::format_to(Text(xml), "<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n", vertices, frame.faces.size());
  append_cell_data(xml, frame);
  append_geometry(xml, packing);
  return xml + std::string(vtk_foot);
}

std::string pvd_file(std::span<const TimedFile> files) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& file : files) {
    fmt::format_to(Text(xml), "<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", file.time, escaped(file.name));
  }
  return xml + "</Collection>\n</VTKFile>\n";
}

}  // namespace isojam
