#include <array>

#include "tasks/extras/export/formats.hpp"
#include "tasks/extras/export/vtk_xml.hpp"

namespace isojam {
namespace {

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

}  // namespace isojam
