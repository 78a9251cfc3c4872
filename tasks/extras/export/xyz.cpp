#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <iterator>
#include <string_view>
#include <vector>

#include "tasks/extras/export/formats.hpp"

namespace isojam {
namespace {

using Text = std::back_insert_iterator<std::string>;

/// Readers such as ASE's accept only the symbols of elements as species. X is not an element.
std::string_view species(const Composition& solids, std::size_t particle) {
  constexpr std::array<std::string_view, 32> symbols{"H",  "He", "Li", "Be", "B",  "C",  "N",  "O",  "F",  "Ne", "Na",
                                                     "Mg", "Al", "Si", "P",  "S",  "Cl", "Ar", "K",  "Ca", "Sc", "Ti",
                                                     "V",  "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn", "Ga", "Ge"};
  if (solids.kinds() < 2) return "X";
  return symbols[static_cast<std::size_t>(solids.kind(particle)) % symbols.size()];
}

void append_frame(std::string& text, const ExportFrame& frame) {
  const auto& packing = frame.packing;
  const bool sized = !packing.solids.is_uniform();
  const Eigen::Matrix3d& h = packing.cell.vectors().high;
  const std::vector<double> vectors(h.data(), h.data() + 9);  // the three lattice vectors, one after another
  fmt::format_to(Text(text),
                 "{0}\nLattice=\"{1}\" pbc=\"T T T\" "
                 "Properties=species:S:1:solid:S:1:{3}pos:R:3:orientation:R:4:n_neighb:I:1:cluster:I:1 density={2}",
                 packing.size(), fmt::join(vectors, " "), packing.density(), sized ? "size:R:1:" : "");
  if (frame.delta_phi) fmt::format_to(Text(text), " delta_phi={}", *frame.delta_phi);
  text += '\n';
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const auto& pose = packing.poses[i];
    const auto x = into_cell(packing.cell, pose.position).wrapped;
    const auto q = pose.orientation.normalized();
    fmt::format_to(Text(text), "{} {}", species(packing.solids, i), packing.solids[i].name());
    if (sized) fmt::format_to(Text(text), " {}", packing.solids[i].scale());
    fmt::format_to(Text(text), " {} {} {} {} {} {} {} {} {}\n", x[0], x[1], x[2], q.x(), q.y(), q.z(), q.w(),
                   frame.Z[i], frame.cluster[i]);
  }
}

}  // namespace

std::string xyz_file(std::span<const ExportFrame> frames) {
  check_frames(frames);
  std::string text;
  for (const auto& frame : frames) append_frame(text, frame);
  return text;
}

std::string obj_file(const ConvexSolid& solid) {
  auto text = fmt::format("# {} of {} volume, centred on its centroid\no {}\n", solid.name(),
                          solid.scale() == 1 ? "unit" : fmt::format("{}", solid.volume()), solid.name());
  for (const auto& v : solid.vertices()) fmt::format_to(Text(text), "v {} {} {}\n", v[0], v[1], v[2]);
  for (const auto& face : solid.faces()) {
    text += 'f';
    for (const int vertex : face.vertices) fmt::format_to(Text(text), " {}", vertex + 1);
    text += '\n';
  }
  return text;
}

}  // namespace isojam
