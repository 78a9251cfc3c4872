#include "tasks/extras/report/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "engine/analysis/orientation_order.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/spectrum.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

/// Lengths are rounded to multiples of 1/length_unit, and components of modes to multiples of 1/mode_unit. More digits
/// would not be visible on a screen.
constexpr double length_unit = 1e5, mode_unit = 1e3;
/// Forces are in thousandths of the largest one, and points of contacts in hundredths of a length.
constexpr double force_parts = 1000, place_parts = 100;
/// For larger packings, the dense solver would take minutes, which is too long for a view.
constexpr int largest_dense_view = 100;

double shortened(double x, double unit) {
  const double rounded = std::round(x * unit) / unit;
  return rounded == 0 ? 0 : rounded;  // avoids "-0.0"
}

template <class Vector>
Json shortened_list(const Vector& v, double unit) {
  Json list = Json::array();
  for (Eigen::Index k = 0; k < v.size(); ++k) list.push_back(shortened(v[k], unit));
  return list;
}

Eigen::Vector3d wrapped(const Eigen::Vector3d& x, const PeriodicCell& cell) {
  const Eigen::Vector3d cells = cell.fractional(x).array().floor();
  return x - cell.translation(cells.cast<int>());
}

Json vectors_of(const PeriodicCell& cell) {
  Json vectors = Json::array();
  for (int c = 0; c < 3; ++c)
    vectors.push_back(shortened_list(Eigen::Vector3d(cell.vectors().high.col(c)), length_unit));
  return vectors;
}

void put_poses(Json& json, const Packing& packing) {
  json["positions"] = json["orientations"] = Json::array();
  for (const auto& pose : packing.poses) {
    json["positions"].push_back(shortened_list(wrapped(pose.position, packing.cell), length_unit));
    const auto& q = pose.orientation.coeffs();
    json["orientations"].push_back(shortened_list(Eigen::Vector4d(q[3], q[0], q[1], q[2]), length_unit));
  }
}

void put_contacts(Json& json, std::span<const Contact> contacts, int particles) {
  std::vector<int> numbers(static_cast<std::size_t>(particles), 0);
  for (const auto& contact : contacts) {
    ++numbers[static_cast<std::size_t>(contact.pair.a)];
    ++numbers[static_cast<std::size_t>(contact.pair.b)];
  }
  json["contacts"] = numbers;
  json["local_Q6"] = Json::array();
  for (const auto& order : local_steinhardt_order(contacts, particles, 6))
    json["local_Q6"].push_back(order ? Json(shortened(*order, mode_unit)) : Json(nullptr));
}

/// Point where the force of a contact is drawn, relative to the centre of A and in the body frame of A. It is where the
/// line of action leaves A towards B. At this point, the force causes the torque of the contact, except for the
/// component along the line.
Eigen::Vector3d place_of_force(const Contact& contact, const ConvexSolid& a) {
  const auto& [area, moment] = std::tie(contact.overlap.area, contact.overlap.moment);
  const Eigen::Vector3d along = area.normalized();
  const Eigen::Vector3d on_line = area.cross(moment) / area.squaredNorm();
  double exit = std::numeric_limits<double>::infinity();
  for (const auto& face : a.faces()) {
    const double slope = face.normal.dot(along);
    if (slope > 0) exit = std::min(exit, (face.offset - face.normal.dot(on_line)) / slope);
  }
  return on_line + along * exit;
}

void put_forces(Json& json, std::span<const Contact> contacts, const Packing& packing) {
  const auto force_of = [](const Overlap& overlap) { return overlap.volume / 2 * overlap.area.norm(); };
  double largest = 0;
  for (const auto& contact : contacts) largest = std::max(largest, force_of(contact.overlap));
  json["largest_force"] = largest;
  json["forces"] = Json::array();
  for (const auto& contact : contacts) {
    if (!(contact.overlap.area.squaredNorm() > 0)) continue;  // the square of the area underflows to zero
    const auto& pose = packing.poses[static_cast<std::size_t>(contact.pair.a)];
    const Eigen::Vector3d place = pose.orientation.normalized() *
                                  place_of_force(contact, packing.solids[static_cast<std::size_t>(contact.pair.a)]);
    json["forces"].insert(json["forces"].end(), {contact.pair.a, contact.pair.b,
                                                 std::lround(force_parts * force_of(contact.overlap) / largest)});
    for (const double x : place) json["forces"].push_back(std::lround(place_parts * x));
  }
}

void put_clusters(Json& json, const Packing& packing, const ClassifiedContacts& classified) {
  json["clusters"] = json["largest"] = nullptr;
  if (const auto why = undecided(classified.analysis)) {
    json["clusters_reason"] = *why;
    return;
  }
  const auto clusters = find_clusters(packing, bonds_of(classified.contacts, classified.analysis.classes));
  json["clusters"] = cluster_labels(clusters, packing.size());
  const auto largest = std::max_element(clusters.begin(), clusters.end(),
                                        [](const Cluster& a, const Cluster& b) { return a.size() < b.size(); });
  if (largest->size() > 1) json["largest"] = unwrapped_cluster(packing, *largest);
}

/// Changes coordinates (x, R·θ) to (x, θ), and scales the mode so that its largest component is 1.
Eigen::VectorXd displacements(Eigen::VectorXd mode, const Composition& solids) {
  for (Eigen::Index i = 0; i < mode.size(); i += 6)
    mode.segment<3>(i + 3) /= solids[static_cast<std::size_t>(i / 6)].gyration_radius();
  return mode / mode.cwiseAbs().maxCoeff();
}

void append_modes(Json& list, const ModeSet& set, std::string_view end, const Packing& packing) {
  const Eigen::MatrixXd moves = mode_displacements(packing, set.vectors);
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    const double lambda = set.eigenvalues[k];
    Json mode;
    mode["end"] = end;
    mode["omega"] = lambda > 0 ? Json(std::sqrt(lambda)) : Json(nullptr);
    mode["u"] = shortened_list(displacements(moves.col(k), packing.solids), mode_unit);
    list.push_back(std::move(mode));
  }
}

Json mode_list(const Packing& packing, PackingEnergy& energy, int modes) {
  Json list = Json::array();
  if (modes == 0) return list;
  const ModeOptions options{.lowest = modes, .highest = modes, .largest_dense = largest_dense_view};
  // The low parts of the coordinates affect the softest modes: without them, faces that barely touch could be apart.
  const auto ends =
      spectrum_ends(dynamical_matrix(packing, energy.hessian(packing, Precision::double_double)), options);
  append_modes(list, ends.lowest, "lowest", packing);
  append_modes(list, ends.highest, "highest", packing);
  return list;
}

}  // namespace

std::vector<ChosenView> choose_views(std::span<const Viewable> all, const ViewOptions& options) {
  std::map<std::string, std::vector<std::size_t>> points;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!all[k].failed) points[all[k].point].push_back(k);
  }
  std::size_t most = 0;
  for (auto& [point, replicates] : points) {
    std::stable_partition(replicates.begin(), replicates.end(), [&](std::size_t k) { return !all[k].flagged; });
    most = std::max(most, replicates.size());
  }
  std::vector<ChosenView> chosen;
  int left = options.budget, room = options.most_particles;
  for (std::size_t turn = 0; turn < most; ++turn) {
    for (const auto& [point, replicates] : points) {
      if (turn >= replicates.size()) continue;
      const int particles = all[replicates[turn]].particles;
      if (turn > 0 && particles > room) continue;
      room -= particles;
      const bool affordable = particles <= left;
      if (affordable) left -= particles;
      chosen.push_back({replicates[turn], affordable});
    }
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const ChosenView& a, const ChosenView& b) { return a.replicate < b.replicate; });
  return chosen;
}

namespace {

/// Shape and size of each particle.
void put_solids(Json& json, const Composition& solids, int particles) {
  json["kind"] = json["size"] = Json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(particles); ++i) {
    json["kind"].push_back(solids.kind(i));
    json["size"].push_back(shortened(solids[i].scale(), length_unit));
  }
}

}  // namespace

Json packing_view(const Packing& packing, int modes, double gap) {
  PackingEnergy energy;
  const auto classified = classified_contacts(packing, energy, gap);
  Json json;
  json["solid"] = packing.solids.unit(0).name();  // if this is a mixture, its name is stored elsewhere
  if (!packing.solids.is_uniform()) put_solids(json, packing.solids, packing.size());
  json["density"] = packing.density();
  json["side"] = packing.cell.side();
  json["cell"] = vectors_of(packing.cell);
  put_poses(json, packing);
  put_contacts(json, classified.contacts, packing.size());
  put_forces(json, energy.contacts(packing), packing);
  put_clusters(json, packing, classified);
  json["modes"] = mode_list(packing, energy, modes);
  return json;
}

Json unwrapped_cluster(const Packing& packing, const Cluster& cluster) {
  const Eigen::Vector3d middle = packing.cell.vectors().high * Eigen::Vector3d::Constant(0.5);
  std::vector<Eigen::Vector3d> positions;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < cluster.members.size(); ++k) {
    const auto& pose = packing.poses[static_cast<std::size_t>(cluster.members[k])];
    positions.emplace_back(pose.position + packing.cell.translation(cluster.images[k]));
    centre += positions.back() / cluster.size();
  }
  Json json;
  json["members"] = cluster.members;
  json["winding_rank"] = cluster.winding_rank();
  json["positions"] = Json::array();
  for (const auto& x : positions) {
    const Eigen::Vector3d centred = x - centre + middle;
    json["positions"].push_back(shortened_list(centred, length_unit));
  }
  return json;
}

Json solid_shape(const ConvexSolid& solid) {
  Json json;
  json["circumradius"] = solid.circumradius();
  json["vertices"] = json["faces"] = json["edges"] = Json::array();
  for (const auto& vertex : solid.vertices()) json["vertices"].push_back(shortened_list(vertex, length_unit));
  for (const auto& face : solid.faces()) json["faces"].push_back(face.vertices);
  for (const auto& edge : solid.edges()) json["edges"].push_back({edge.tail, edge.head});
  return json;
}

}  // namespace isojam
