#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

#include "tasks/extras/export/formats.hpp"

namespace isojam {
namespace {

using Text = std::back_insert_iterator<std::string>;

/// Appends an array with the values values(k) for k = 0, …, count − 1. Each line of text contains `per_line` values.
template <class Values>
void append_array(std::string& xml, std::string_view type, std::string_view attributes, std::size_t count,
                  std::size_t per_line, const Values& values) {
  fmt::format_to(Text(xml), "<DataArray type=\"{}\" {} format=\"ascii\">\n", type, attributes);
  for (std::size_t k = 0; k < count; ++k) {
    fmt::format_to(Text(xml), "{}{}", values(k), (k + 1) % per_line == 0 || k + 1 == count ? '\n' : ' ');
  }
  xml += "</DataArray>\n";
}

void append_field(std::string& xml, std::string_view name, double value) {
  append_array(xml, "Float64", fmt::format("Name=\"{}\" NumberOfTuples=\"1\"", name), 1, 1,
               [&](std::size_t) { return value; });
}

/// The beginning of a PolyData file, up to the element Piece. Field data: side, cell (three lattice vectors) unless it
/// is a cube, density, and delta_phi if the frame has it. `explanation` is an XML comment, or empty.
std::string vtk_head(const ExportFrame& frame, std::string_view explanation) {
  const auto& packing = frame.packing;
  std::string xml = "<?xml version=\"1.0\"?>\n";
  xml += explanation;
  xml +=
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
      "<FieldData>\n";
  append_field(xml, "side", packing.cell.side());
  if (!packing.cell.is_cube()) {
    const Eigen::Matrix3d& h = packing.cell.vectors().high;
    append_array(xml, "Float64", "Name=\"cell\" NumberOfComponents=\"9\" NumberOfTuples=\"1\"", 9, 9,
                 [&](std::size_t k) { return h.data()[k]; });
  }
  append_field(xml, "density", packing.density());
  if (frame.delta_phi) append_field(xml, "delta_phi", *frame.delta_phi);
  return xml + "</FieldData>\n";
}

/// The end of a PolyData file, from the end of the element Piece.
constexpr std::string_view vtk_foot = "</Piece>\n</PolyData>\n</VTKFile>\n";

// ---- Faces of particles ---------------------------------------------------------------------------------------------

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

// ---- Contact networks -----------------------------------------------------------------------------------------------

constexpr auto lines_explanation =
    "<!-- A line for each contact: centre of a, point of application of the force, centre of the touching image of b. "
    "contact_class, by the fitted cut-offs: 3: face-face, 2: edge-face, 1: lower-order, -1: undecided. kind, by the "
    "shape of the intersection: 0: vertex-face, 1: edge-edge, 2: edge-face, 3: face-face, 4: none of these. force: on "
    "a. Lengths are in units of V_p^(1/3), forces in units of Y V_p^(2/3). -->\n";

/// Three points of each contact: a centre, the point of application, and the other centre.
std::vector<double> points_of(const Packing& packing, const std::vector<NetworkContact>& network) {
  std::vector<double> coordinates;
  for (const auto& contact : network) {
    const auto& a = packing.poses[static_cast<std::size_t>(contact.pair.a)].position;
    const Eigen::Vector3d moved = into_cell(packing.cell, a).wrapped - a;
    const Eigen::Vector3d b = a + displacement(packing, contact.pair);
    for (const Eigen::Vector3d& point : std::array<Eigen::Vector3d, 3>{a, contact.force.attack, b}) {
      const Eigen::Vector3d here = point + moved;
      coordinates.insert(coordinates.end(), here.begin(), here.end());
    }
  }
  return coordinates;
}

std::int32_t class_of(const NetworkContact& contact) {
  if (!contact.contact_class) return static_cast<std::int32_t>(FaceContact::undecided);
  return static_cast<std::int32_t>(strength_of(*contact.contact_class));
}

/// Appends the data of every line.
class LineData {
 public:
  LineData(std::string& xml, const std::vector<NetworkContact>& network) : xml_(xml), network_(network) {}

  template <class Value>
  void numbers(std::string_view name, std::string_view type, const Value& value) {
    append_array(xml_, type, fmt::format("Name=\"{}\"", name), network_.size(), 1,
                 [&](std::size_t k) { return value(network_[k]); });
  }
  template <class Value>
  void vectors(std::string_view name, const Value& value) {
    append_array(xml_, "Float64", fmt::format("Name=\"{}\" NumberOfComponents=\"3\"", name), 3 * network_.size(), 3,
                 [&](std::size_t k) { return value(network_[k / 3])[static_cast<Eigen::Index>(k % 3)]; });
  }

 private:
  std::string& xml_;
  const std::vector<NetworkContact>& network_;
};

void append_data(std::string& xml, const std::vector<NetworkContact>& network) {
  xml += "<CellData Scalars=\"force\">\n";
  LineData data(xml, network);
  using C = NetworkContact;
  data.numbers("a", "Int32", [](const C& c) { return c.pair.a; });
  data.numbers("b", "Int32", [](const C& c) { return c.pair.b; });
  data.numbers("contact_class", "Int32", class_of);
  data.numbers("kind", "Int32", [](const C& c) { return static_cast<std::int32_t>(c.force.kind); });
  data.numbers("force", "Float64", [](const C& c) { return c.force.force_a.norm(); });
  data.vectors("force_a", [](const C& c) { return c.force.force_a; });
  data.vectors("normal", [](const C& c) { return c.force.normal; });
  data.numbers("volume", "Float64", [](const C& c) { return c.force.volume; });
  data.numbers("area", "Float64", [](const C& c) { return c.force.area; });
  data.numbers("depth", "Float64", [](const C& c) { return c.force.depth; });
  data.numbers("theta_ef", "Float64", [](const C& c) { return c.alignment.edge_face; });
  data.numbers("theta_ff", "Float64", [](const C& c) { return c.alignment.face_face; });
  xml += "</CellData>\n";
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

std::string vtp_lines_file(const ExportFrame& frame) {
  const auto& network = *frame.network;
  const auto points = points_of(frame.packing, network);
  auto xml = vtk_head(frame, lines_explanation);
  fmt::format_to(Text(xml), "<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n", 3 * network.size(), network.size());
  append_data(xml, network);
  xml += "<Points>\n";
  append_array(xml, "Float64", "Name=\"Points\" NumberOfComponents=\"3\"", points.size(), 3,
               [&](std::size_t k) { return points[k]; });
  xml += "</Points>\n<Lines>\n";
  append_array(xml, "Int64", "Name=\"connectivity\"", 3 * network.size(), 24, [](std::size_t k) { return k; });
  append_array(xml, "Int64", "Name=\"offsets\"", network.size(), 24, [](std::size_t k) { return 3 * (k + 1); });
  return xml + "</Lines>\n" + std::string(vtk_foot);
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
