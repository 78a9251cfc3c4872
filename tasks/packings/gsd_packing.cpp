#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tasks/io/json.hpp"
#include "tasks/packings/foreign_packing.hpp"
#include "tasks/packings/packing_json.hpp"

namespace isojam {
namespace {

/// Lattice vectors (Lx, 0, 0), (xy·Ly, Ly, 0) and (xz·Lz, yz·Lz, Lz).
Eigen::Matrix3d cell_of(const std::vector<double>& box) {
  Eigen::Matrix3d cell = Eigen::Matrix3d::Zero();
  cell.diagonal() << box[0], box[1], box[2];
  cell(0, 1) = box[3] * box[1], cell(0, 2) = box[4] * box[2], cell(1, 2) = box[5] * box[2];
  return cell;
}

/// Empty for a type without a polyhedron.
std::vector<Eigen::Vector3d> vertices_of(const std::string& text) {
  const auto shape = Json::parse(text, nullptr, false);
  std::vector<Eigen::Vector3d> vertices;
  if (!shape.is_object() || !shape.contains("vertices") || !shape.at("vertices").is_array()) return vertices;
  for (const auto& vertex : shape.at("vertices")) {
    if (!vertex.is_array() || vertex.size() != 3 ||
        !std::all_of(vertex.begin(), vertex.end(), [](const Json& x) { return x.is_number(); }))
      throw NoPackingFile("a vertex of a shape is not three numbers");
    vertices.emplace_back(vertex[0].get<double>(), vertex[1].get<double>(), vertex[2].get<double>());
  }
  if (shape.contains("rounding_radius") && shape.at("rounding_radius") != 0)
    throw NoPackingFile("rounded shapes are not supported");
  return vertices;
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
    throw NoPackingFile(
        fmt::format("its chunk particles/{} does not have a row for each of {} particles", name, count));
  if (!std::all_of(values->begin(), values->end(), [](double x) { return std::isfinite(x); }))
    throw NoPackingFile(fmt::format("its chunk particles/{} contains a value that is not a finite number", name));
  return *values;
}

}  // namespace

ForeignPacking read_gsd_packing(const std::string& bytes, int frame) {
  const GsdFile file(bytes);
  if (file.schema() != "hoomd")
    throw NoPackingFile(fmt::format("its schema is \"{}\" instead of \"hoomd\"", file.schema()));
  const auto frames = static_cast<std::int64_t>(file.frames());
  const auto index = frame < 0 ? frames + frame : frame;
  if (index < 0 || index >= frames) throw NoPackingFile(fmt::format("it has only {} frames", frames));
  const auto which = static_cast<std::uint64_t>(index);

  ForeignPacking packing;
  const auto box = file.numbers(which, "configuration/box", 1);
  if (!box || box->size() != 6) throw NoPackingFile("it has no box");
  packing.cell = cell_of(*box);
  const auto number = file.numbers(which, "particles/N", 1);
  if (!number || number->size() != 1 || !((*number)[0] >= 1 && (*number)[0] <= static_cast<double>(most_particles)))
    throw NoPackingFile(fmt::format("it has no particles, or more than {}", most_particles));
  const auto n = static_cast<std::size_t>((*number)[0]);
  const auto names = file.texts(which, "particles/types").value_or(std::vector<std::string>{"A"});
  const auto shapes = file.texts(which, "particles/type_shapes").value_or(std::vector<std::string>{});
  for (std::size_t k = 0; k < names.size(); ++k)
    packing.types.push_back({names[k], k < shapes.size() ? vertices_of(shapes[k]) : std::vector<Eigen::Vector3d>{}});
  if (!file.numbers(which, "particles/position", 3)) throw NoPackingFile("it has no positions");
  const auto positions = of_all(file, which, "position", n, {0, 0, 0});
  const auto orientations = of_all(file, which, "orientation", n, {1, 0, 0, 0});
  const auto types = of_all(file, which, "typeid", n, {0});
  for (std::size_t i = 0; i < n; ++i) {
    if (!(types[i] >= 0 && types[i] < static_cast<double>(names.size())))
      throw NoPackingFile("a particle has an undefined type");
    const double *x = &positions[3 * i], *q = &orientations[4 * i];
    const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
    if (!(orientation.norm() > 0.5)) throw NoPackingFile(fmt::format("particle {} has no orientation", i));
    packing.bodies.push_back({static_cast<int>(types[i]), 1, {x[0], x[1], x[2]}, orientation.normalized()});
  }
  return packing;
}

}  // namespace isojam
