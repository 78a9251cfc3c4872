#include <fmt/format.h>

#include <algorithm>

#include "tasks/io/json.hpp"
#include "tasks/packings/foreign_packing.hpp"
#include "tasks/packings/intake.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

/// Files may define a few types without particles.
constexpr std::size_t most_unused_types = 1000;

/// Lattice vectors (Lx, 0, 0), (xy·Ly, Ly, 0) and (xz·Lz, yz·Lz, Lz).
Eigen::Matrix3d cell_of(const std::vector<double>& box) {
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();
  cell.diagonal() << box[0], box[1], box[2];
  cell(0, 1) = box[3] * box[1], cell(0, 2) = box[4] * box[2], cell(1, 2) = box[5] * box[2];
  return cell;
}

/// Reads the vertices of a shape. Returns false if there are none.
bool read_vertices(const Json& shape, ForeignPacking::Type& type) {
  if (!shape.contains("vertices") || !shape.at("vertices").is_array()) {
    type.foreign_shape = "without vertices";
    return false;
  }
  for (const auto& vertex : shape.at("vertices")) {
    if (!vertex.is_array() || vertex.size() != 3 ||
        !std::all_of(vertex.begin(), vertex.end(), [](const Json& x) { return x.is_number(); }))
      throw ContentError(fmt::format("a vertex of the shape of type {} is not three numbers", in_quotes(type.name)));
    type.vertices.emplace_back(vertex[0].get<double>(), vertex[1].get<double>(), vertex[2].get<double>());
  }
  return true;
}

/// A shape of vertices and faces, which must be the surface of a convex solid.
void read_convex_mesh(const Json& shape, ForeignPacking::Type& type) {
  if (!read_vertices(shape, type)) return;
  Mesh mesh{type.vertices, {}, {}};
  for (const auto& face : shape.value("indices", Json::array())) {
    auto& corners = mesh.faces.emplace_back().points;
    for (const auto& corner : face) {
      if (!corner.is_number_unsigned() || corner.get<std::size_t>() >= mesh.points.size())
        throw ContentError(fmt::format("a face of the shape of type {} has no valid index", in_quotes(type.name)));
      corners.push_back(corner.get<std::size_t>());
    }
  }
  try {
    type.vertices = solid_in(mesh, {}).vertices;
  } catch (const ContentError& error) {
    type.vertices.clear();
    type.foreign_shape = fmt::format("of the kind \"Mesh\", {}", error.what());
  }
}

/// The shape of a type. A text such as "" or "{}" describes no shape.
void read_shape(const std::string& text, ForeignPacking::Type& type) {
  if (text.find_first_not_of(" \t\n") == std::string::npos) return;
  const auto shape = parsed(text, false);
  if (shape.is_null() || (shape.is_object() && shape.empty())) return;
  if (!shape.is_object()) {
    type.foreign_shape = "that is not a JSON object";
    return;
  }
  const auto kind = shape.contains("type") && shape.at("type").is_string() ? shape.at("type").get<std::string>() : "";
  if (kind == "Mesh") {
    read_convex_mesh(shape, type);
    return;
  }
  if (kind != "ConvexPolyhedron") {
    type.foreign_shape = kind.empty() ? "without a type" : "of the kind " + in_quotes(kind);
    return;
  }
  if (!read_vertices(shape, type)) return;
  if (shape.contains("rounding_radius") && shape.at("rounding_radius") != 0) type.foreign_shape = "with rounded edges";
}

/// Values of all particles; `fallback` if the file has none.
std::vector<double> of_all(const GsdFile& file, std::uint64_t frame, const std::string& name, std::size_t count,
                           const std::vector<double>& fallback) {
  const auto columns = static_cast<std::uint32_t>(fallback.size());
  auto values = file.numbers(frame, "particles/" + name, columns);
  if (!values) {
    std::vector<double> same;
    for (std::size_t k = 0; k < count; ++k) same.insert(same.end(), fallback.begin(), fallback.end());
    return same;
  }
  if (values->size() != count * columns)
    throw ContentError(fmt::format("its chunk particles/{} does not have a row for each of {} particles", name, count));
  return *values;
}

}  // namespace

ForeignPacking read_gsd_packing(const std::string& bytes, int frame) {
  const GsdFile file(bytes);
  if (file.schema() != "hoomd")
    throw ContentError(fmt::format("its schema is \"{}\" instead of \"hoomd\"", file.schema()));
  const std::uint64_t which = index_of_frame(file.frames(), frame);

  ForeignPacking packing;
  const auto box = file.numbers(which, "configuration/box", 1);
  if (!box || box->size() != 6) throw ContentError("it has no box");
  const auto dimensions = file.numbers(which, "configuration/dimensions", 1);
  if ((dimensions && dimensions->size() == 1 && (*dimensions)[0] == 2) || (*box)[2] == 0)
    throw ContentError("it is two-dimensional", "use a packing in three dimensions");
  packing.cell = cell_of(*box);
  const auto number = file.numbers(which, "particles/N", 1);
  if (!number || number->size() != 1 || !((*number)[0] >= 1 && (*number)[0] <= static_cast<double>(most_particles)))
    throw ContentError(fmt::format("it has no particles, or more than {}", most_particles));
  const auto n = static_cast<std::size_t>((*number)[0]);
  const auto names = file.texts(which, "particles/types").value_or(std::vector<std::string>{"A"});
  const auto shapes = file.texts(which, "particles/type_shapes").value_or(std::vector<std::string>{});
  if (names.size() > std::max(n, most_unused_types))
    throw ContentError(fmt::format("it has {} types for {} particles", names.size(), n), "remove the unused types");
  for (std::size_t k = 0; k < names.size(); ++k) {
    auto& type = packing.types.emplace_back();
    type.name = names[k];
    if (k < shapes.size()) read_shape(shapes[k], type);
  }
  const auto positions = of_all(file, which, "position", n, {0, 0, 0});
  const auto orientations = of_all(file, which, "orientation", n, {1, 0, 0, 0});
  const auto types = of_all(file, which, "typeid", n, {0});
  for (std::size_t i = 0; i < n; ++i) {
    if (!(types[i] >= 0 && types[i] < static_cast<double>(names.size())))
      throw ContentError("a particle has an undefined type");
    const double *x = &positions[3 * i], *q = &orientations[4 * i];
    const auto orientation = unit_quaternion({q[0], q[1], q[2], q[3]}, i, "w x y z");
    packing.bodies.push_back({static_cast<int>(types[i]), 1, {x[0], x[1], x[2]}, orientation});
  }
  return packing;
}

}  // namespace isojam
