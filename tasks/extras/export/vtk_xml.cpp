#include "tasks/extras/export/vtk_xml.hpp"

namespace isojam {
namespace {

void append_field(std::string& xml, std::string_view name, double value) {
  append_array(xml, "Float64", fmt::format("Name=\"{}\" NumberOfTuples=\"1\"", name), 1, 1,
               [&](std::size_t) { return value; });
}

}  // namespace

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

}  // namespace isojam
