#include "engine/analysis/cluster_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;

/// A cluster that does not wind, with centres that are unwrapped along its bonds.
struct Network {
  std::vector<Vector3d> centres;
  std::vector<std::vector<int>> neighbours;
  double square_bond = 0;  ///< mean square length of a bond
};

Network unwrapped(const Packing& packing, const Cluster& cluster, std::span<const NeighbourPair> bonds) {
  Network network;
  std::vector<int> place(packing.poses.size(), -1);
  for (int m = 0; m < cluster.size(); ++m) {
    place[cluster.members[m]] = m;
    network.centres.emplace_back(packing.poses[cluster.members[m]].position +
                                 packing.cell.translation(cluster.images[m]));
  }
  network.neighbours.resize(network.centres.size());
  long count = 0;
  for (const NeighbourPair& bond : bonds) {
    const int a = place[bond.a], b = place[bond.b];
    if (a < 0) continue;
    network.neighbours[a].push_back(b);
    network.neighbours[b].push_back(a);
    network.square_bond += (network.centres[b] - network.centres[a]).squaredNorm();
    ++count;
  }
  if (count > 0) network.square_bond /= static_cast<double>(count);
  return network;
}

/// Members, sorted by their distance in bonds from one of them, and the numbers of members within ℓ = 0, 1, … bonds.
struct Growth {
  std::vector<int> order;
  std::vector<std::size_t> within;
};

Growth grow(const Network& network, int from) {
  Growth growth;
  std::vector<char> seen(network.centres.size(), 0);
  growth.order.push_back(from);
  seen[from] = 1;
  for (std::size_t next = 0; next < growth.order.size();) {
    const std::size_t shell_end = growth.order.size();
    growth.within.push_back(shell_end);
    for (; next < shell_end; ++next) {
      for (const int neighbour : network.neighbours[growth.order[next]]) {
        if (seen[neighbour]) continue;
        seen[neighbour] = 1;
        growth.order.push_back(neighbour);
      }
    }
  }
  return growth;
}

double square_gyration_radius(const Network& network, std::span<const int> piece) {
  Vector3d mean = Vector3d::Zero();
  for (const int m : piece) mean += network.centres[m] / static_cast<double>(piece.size());
  double sum = 0;
  for (const int m : piece) sum += (network.centres[m] - mean).squaredNorm();
  return sum / static_cast<double>(piece.size());
}

/// Means of log ρ and log s over the pieces with one ℓ.
struct Point {
  double log_radius = 0, log_size = 0;
  int pieces = 0;
};

/// Element ℓ − 1 of the result belongs to the pieces of radius ℓ around every member. For each member, the last piece
/// is the first that is the whole cluster.
std::vector<Point> piece_sizes(const Network& network) {
  std::vector<Point> points;
  for (std::size_t from = 0; from < network.centres.size(); ++from) {
    const Growth growth = grow(network, static_cast<int>(from));
    if (growth.within.size() - 1 > points.size()) points.resize(growth.within.size() - 1);
    for (std::size_t l = 1; l < growth.within.size(); ++l) {
      const std::span<const int> piece = std::span(growth.order).first(growth.within[l]);
      const double square = square_gyration_radius(network, piece) + network.square_bond / 12;
      points[l - 1].log_radius += nearest::log(square) / 2;
      points[l - 1].log_size += nearest::log(static_cast<double>(piece.size()));
      ++points[l - 1].pieces;
    }
  }
  for (Point& point : points) {
    point.log_radius /= point.pieces;
    point.log_size /= point.pieces;
  }
  return points;
}

/// Least-squares slope of log_size as a function of log_radius. The verdict is too_small if all radii are equal or 0.
FractalDimension fit_line(std::span<const Point> points) {
  const auto n = static_cast<double>(points.size());
  double x = 0, y = 0;
  for (const Point& point : points) {
    x += point.log_radius / n;
    y += point.log_size / n;
  }
  double xx = 0, xy = 0, scatter = 0;
  for (const Point& point : points) {
    xx += (point.log_radius - x) * (point.log_radius - x);
    xy += (point.log_radius - x) * (point.log_size - y);
  }
  FractalDimension result{.verdict = DimensionVerdict::too_small, .points = static_cast<int>(points.size())};
  if (!(xx > 0)) return result;  // all centres coincide: logarithms of 0
  result.verdict = DimensionVerdict::fitted;
  result.D = xy / xx;
  for (const Point& point : points) {
    const double deviation = point.log_size - y - result.D * (point.log_radius - x);
    scatter += deviation * deviation;
  }
  result.error = std::sqrt(scatter / ((n - 2) * xx));
  return result;
}

}  // namespace

FractalDimension fractal_dimension(const Packing& packing, const Cluster& cluster,
                                   std::span<const NeighbourPair> bonds) {
  if (cluster.winding_rank() > 0) return {.verdict = DimensionVerdict::winds};
  const std::vector<Point> points = piece_sizes(unwrapped(packing, cluster, bonds));
  if (points.size() < 3) return {.verdict = DimensionVerdict::too_small, .points = static_cast<int>(points.size())};
  return fit_line(points);
}

ClusterStatistics cluster_statistics(const Packing& packing, std::span<const NeighbourPair> bonds,
                                     std::span<const Cluster> clusters) {
  if (clusters.empty()) throw std::invalid_argument("cluster statistics need at least one cluster");
  ClusterStatistics statistics;
  long particles = 0, squares = 0;
  double longest = -1, longest_body = 0;
  bool winds = false;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const Cluster& cluster = clusters[c];
    particles += cluster.size();
    squares += static_cast<long>(cluster.size()) * cluster.size();
    statistics.largest = std::max(statistics.largest, cluster.size());
    statistics.winding_rank = std::max(statistics.winding_rank, cluster.winding_rank());
    statistics.spans |= cluster.spans(packing.cell.side());
    const std::optional<double> extent = cluster.longest_extent();
    if (winds) continue;
    if (!extent || *extent > longest) statistics.longest = static_cast<int>(c);
    winds = !extent;
    if (winds) continue;
    longest = std::max(longest, *extent);
    for (const std::optional<double>& body : cluster.body_extent) longest_body = std::max(longest_body, *body);
  }
  statistics.S = static_cast<double>(squares) / static_cast<double>(particles);
  if (!winds) {
    statistics.l_max = longest / packing.cell.side();
    statistics.body_l_max = longest_body / packing.cell.side();
  }
  statistics.D_max = fractal_dimension(packing, clusters[statistics.longest], bonds);
  return statistics;
}

}  // namespace isojam
