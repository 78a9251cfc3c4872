#include <fmt/format.h>

#include <map>
#include <utility>
#include <vector>

#include "tasks/extras/export/contact_network.hpp"
#include "tasks/extras/export/formats.hpp"
#include "tasks/io/json.hpp"
#include "tasks/io/version.hpp"
#include "tasks/packings/gsd_layer.hpp"

namespace isojam {
namespace {

/// JSON text for a convex polyhedron, as the page on shapes in the GSD documentation defines it.
std::string shape_text(const ConvexSolid& solid) {
  Json shape;
  shape["type"] = "ConvexPolyhedron";
  shape["rounding_radius"] = 0;
  for (const auto& vertex : solid.vertices()) shape["vertices"].push_back({vertex[0], vertex[1], vertex[2]});
  return shape.dump();
}

template <class T>
GsdChunk one(std::string name, T value) {
  return gsd_chunk(std::move(name), std::span<const T>(&value, 1));
}

template <class T>
GsdChunk many(std::string name, const std::vector<T>& values, std::uint32_t columns = 1) {
  return gsd_chunk(std::move(name), std::span<const T>(values), columns);
}

/// The types of the particles: solids that differ in shape or size, in the order in which they first occur. Also the
/// type of each particle.
struct Types {
  std::vector<const ConvexSolid*> solids;
  std::vector<std::uint32_t> of;
};

Types types_of(const Packing& packing) {
  Types types;
  std::map<const ConvexSolid*, std::uint32_t> number;
  for (std::size_t i = 0; i < packing.poses.size(); ++i) {
    const auto* solid = &packing.solids[i];
    const auto [found, added] = number.try_emplace(solid, static_cast<std::uint32_t>(types.solids.size()));
    if (added) types.solids.push_back(solid);
    types.of.push_back(found->second);
  }
  return types;
}

/// Adds values that are constant during a decompression. All later frames of the file inherit them from the first
/// frame.
void append_constants(const Packing& packing, std::vector<GsdChunk>& chunks) {
  const auto n = packing.poses.size();
  chunks.push_back(one("configuration/dimensions", std::uint8_t{3}));
  chunks.push_back(one("particles/N", static_cast<std::uint32_t>(n)));
  const auto types = types_of(packing);
  std::vector<std::string> names, shapes;
  for (const auto* solid : types.solids) {
    names.push_back(types.solids.size() == 1 ? solid->name() : fmt::format("{}_{}", solid->name(), names.size()));
    shapes.push_back(shape_text(*solid));
  }
  chunks.push_back(gsd_chunk("particles/types", names));
  chunks.push_back(gsd_chunk("particles/type_shapes", shapes));
  chunks.push_back(many("particles/typeid", types.of));
  std::vector<float> masses, moments;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& solid = packing.solids[i];
    const double radius = solid.gyration_radius();
    masses.push_back(static_cast<float>(solid.volume()));
    moments.insert(moments.end(), 3, static_cast<float>(solid.volume() * radius * radius));  // their mean, three times
  }
  chunks.push_back(many("particles/mass", masses));
  chunks.push_back(many("particles/moment_inertia", moments, 3));
}

void append_poses(const Packing& packing, std::vector<GsdChunk>& chunks) {
  std::vector<float> positions, orientations;
  std::vector<std::int32_t> images;
  for (const auto& pose : packing.poses) {
    const auto [wrapped, image] = into_centred_cell(packing.cell, pose.position);
    const auto q = pose.orientation.normalized();
    for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(wrapped[c]));
    for (int c = 0; c < 3; ++c) images.push_back(image[c]);
    for (const double component : {q.w(), q.x(), q.y(), q.z()}) orientations.push_back(static_cast<float>(component));
  }
  chunks.push_back(many("particles/position", positions, 3));
  chunks.push_back(many("particles/orientation", orientations, 4));
  chunks.push_back(many("particles/image", images, 3));
}

/// Box in the format of HOOMD-blue. Its lattice vectors are (Lx, 0, 0), (xy·Ly, Ly, 0) and (xz·Lz, yz·Lz, Lz).
std::vector<float> box_of(const PeriodicCell& cell) {
  const Eigen::Matrix3d& h = cell.vectors().high;
  std::vector<float> box;
  for (const double x : {h(0, 0), h(1, 1), h(2, 2), h(0, 1) / h(1, 1), h(0, 2) / h(2, 2), h(1, 2) / h(2, 2)})
    box.push_back(static_cast<float>(x));
  return box;
}

/// The components of the three lattice vectors, one vector after another.
std::vector<double> vectors_of(const PeriodicCell& cell) {
  const Eigen::Matrix3d& h = cell.vectors().high;
  return {h.data(), h.data() + 9};
}

template <class T>
GsdChunk column(const char* name, const std::vector<NetworkContact>& network, const T& value) {
  std::vector<double> values;
  for (const auto& contact : network) values.push_back(value(contact));
  return gsd_chunk(std::string("log/bonds/isojam/") + name, std::span<const double>(values));
}

std::uint32_t type_of(const NetworkContact& contact) {
  if (!contact.contact_class) return static_cast<std::uint32_t>(all_names<ContactClass>.size());
  return static_cast<std::uint32_t>(*contact.contact_class);
}

/// Converts a contact network to bonds of the schema "hoomd". The types of bonds are face_face, edge_face, lower_order
/// and undecided. Each bond has these quantities in log/bonds/isojam/: force (on the first particle, 3 columns),
/// volume, area, depth, theta_ef, theta_ff, and kind (the numbers of ContactKind). `rotation` rotates vectors from the
/// frame of the packing to the frame of the file.
std::vector<GsdChunk> bond_chunks(const std::vector<NetworkContact>& network, const Eigen::Matrix3d& rotation) {
  std::vector<std::string> types;
  for (const auto name : all_names<ContactClass>) types.emplace_back(name);
  types.emplace_back("undecided");
  const auto count = static_cast<std::uint32_t>(network.size());
  std::vector<GsdChunk> chunks{gsd_chunk("bonds/N", std::span(&count, 1)), gsd_chunk("bonds/types", types)};
  if (network.empty()) return chunks;
  std::vector<std::uint32_t> typeid_list;
  std::vector<std::int32_t> group, kind;
  std::vector<double> force;
  for (const auto& contact : network) {
    typeid_list.push_back(type_of(contact));
    group.insert(group.end(), {contact.pair.a, contact.pair.b});
    kind.push_back(static_cast<std::int32_t>(contact.force.kind));
    const Eigen::Vector3d turned = rotation * contact.force.force_a;
    force.insert(force.end(), turned.begin(), turned.end());
  }
  chunks.push_back(gsd_chunk("bonds/typeid", std::span<const std::uint32_t>(typeid_list)));
  chunks.push_back(gsd_chunk("bonds/group", std::span<const std::int32_t>(group), 2));
  chunks.push_back(gsd_chunk("log/bonds/isojam/force", std::span<const double>(force), 3));
  chunks.push_back(gsd_chunk("log/bonds/isojam/kind", std::span<const std::int32_t>(kind)));
  chunks.push_back(column("volume", network, [](const NetworkContact& c) { return c.force.volume; }));
  chunks.push_back(column("area", network, [](const NetworkContact& c) { return c.force.area; }));
  chunks.push_back(column("depth", network, [](const NetworkContact& c) { return c.force.depth; }));
  chunks.push_back(column("theta_ef", network, [](const NetworkContact& c) { return c.alignment.edge_face; }));
  chunks.push_back(column("theta_ff", network, [](const NetworkContact& c) { return c.alignment.face_face; }));
  return chunks;
}

std::vector<GsdChunk> chunks_of(const ExportFrame& frame, std::uint64_t step, bool with_distance) {
  std::vector<GsdChunk> chunks;
  const auto packing = in_standard_frame(frame.packing);
  chunks.push_back(one("configuration/step", step));
  chunks.push_back(many("configuration/box", box_of(packing.cell)));
  if (step == 0) append_constants(packing, chunks);
  append_poses(packing, chunks);
  chunks.push_back(one("log/isojam/density", packing.density()));
  chunks.push_back(one("log/isojam/side", packing.cell.side()));
  if (!packing.cell.is_cube()) chunks.push_back(many("log/isojam/cell", vectors_of(frame.packing.cell), 3));
  if (with_distance) chunks.push_back(one("log/isojam/delta_phi", *frame.delta_phi));
  chunks.push_back(many("log/particles/isojam/Z", frame.Z));
  chunks.push_back(many("log/particles/isojam/cluster", frame.cluster));
  if (frame.network) {
    for (auto& chunk : bond_chunks(*frame.network, to_standard_frame(frame.packing.cell)))
      chunks.push_back(std::move(chunk));
  }
  return chunks;
}

}  // namespace

std::string gsd_file(std::span<const ExportFrame> frames) {
  check_frames(frames);
  bool with_distance = true;
  for (const auto& frame : frames) with_distance = with_distance && frame.delta_phi;
  std::vector<std::vector<GsdChunk>> chunks;
  for (std::size_t k = 0; k < frames.size(); ++k) chunks.push_back(chunks_of(frames[k], k, with_distance));
  return gsd_bytes({"isojam " + std::string(version()), "hoomd", 1, 4}, chunks);
}

}  // namespace isojam
