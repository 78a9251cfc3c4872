#include "tasks/extras/export/gsd_bonds.hpp"

namespace isojam {
namespace {

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

}  // namespace

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

}  // namespace isojam
