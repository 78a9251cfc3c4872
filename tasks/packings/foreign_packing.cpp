#include "tasks/packings/foreign_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/geometry/hull.hpp"
#include "engine/geometry/repair.hpp"
#include "tasks/packings/similarity.hpp"
#include "tasks/packings/surface.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

/// Relative tolerance of a size: rounding of single precision and of a shape's vertices.
constexpr double size_tolerance = 1e-3;
/// Limits image counts, so that they stay far from the range of int.
constexpr double most_cells = 1e6;

/// Assigns a type of the file to one of a mixture's solids.
struct Match {
  const ConvexSolid* solid = nullptr;
  Similarity place;  ///< placement of the solid in the body frame of the type
};

std::optional<Match> match_by_shape(std::span<const Vector3d> vertices, const Mixture& mixture) {
  for (const auto& kind : mixture.kinds()) {
    if (const auto found = similarity(*kind.solid, vertices)) return Match{&*kind.solid, *found};
  }
  return std::nullopt;
}

/// The corners of the convex hull; empty if the points have none.
std::vector<Vector3d> hull_corners(std::span<const Vector3d> points) {
  try {
    if (points.size() <= most_surface_points) return repaired(points, {.hull = true}).vertices;
  } catch (const NoSolid&) {
  }
  return {};
}

/// Finds the solids of types.
class Matching {
 public:
  Matching(const Mixture& mixture, const TypeNames& names, std::vector<std::string>* notes)
      : mixture_(mixture), names_(names), notes_(notes) {}

  Match match_of(const ForeignPacking::Type& type) const {
    const auto named = names_.find(type.name);
    if (!type.foreign_shape.empty())
      throw ContentError(fmt::format("type {} has a shape {}", in_quotes(type.name), type.foreign_shape),
                         "write a ConvexPolyhedron with sharp edges, or no shape, to particles/type_shapes");
    if (!type.vertices.empty() && named != names_.end())
      throw ContentError(fmt::format("type {} has a shape in the file", in_quotes(type.name)),
                         "remove the type from /start/types");
    const auto match = !type.vertices.empty()  ? match_by_vertices(type)
                       : named == names_.end() ? match_by_name(type.name, type.is_element)
                                               : match_by_name(named->second, false);
    if (!match) refuse(type, named == names_.end() ? "" : ", " + named->second + " by /start/types,");
    return *match;
  }

 private:
  std::optional<Match> match_by_name(const std::string& name, bool is_element) const {
    const auto& kinds = mixture_.kinds();
    for (const auto& kind : kinds) {
      if (kind.solid->name() == name) return Match{&*kind.solid, {}};
    }
    const auto is_other = [&](const auto& kind) { return kind.solid->name() != kinds.front().solid->name(); };
    if (!is_element || std::ranges::any_of(kinds, is_other)) return std::nullopt;
    if (notes_)
      notes_->push_back(fmt::format("the element {} is taken for {}, the only solid of the manifest", in_quotes(name),
                                    kinds.front().solid->name()));
    return Match{&*kinds.front().solid, {}};
  }

  std::optional<Match> match_by_vertices(const ForeignPacking::Type& type) const {
    if (auto match = match_by_shape(type.vertices, mixture_)) return match;
    const auto corners = hull_corners(type.vertices);
    const auto inner = type.vertices.size() - corners.size();
    if (corners.empty() || inner == 0) return std::nullopt;
    auto match = match_by_shape(corners, mixture_);
    if (match && notes_)
      notes_->push_back(
          fmt::format("the shape of type {} has {} that {} no corner of its convex hull; isojam uses the "
                      "convex hull",
                      in_quotes(type.name), inner == 1 ? "a vertex" : fmt::format("{} vertices", inner),
                      inner == 1 ? "is" : "are"));
    return match;
  }

  [[noreturn]] void refuse(const ForeignPacking::Type& type, const std::string& named) const {
    throw ContentError(
        fmt::format("particles of type {}{} do not match {}", in_quotes(type.name), named, to_string(mixture_)),
        type.vertices.empty()
            ? fmt::format("name the solid of this type in /start/types, for example {{\"{}\": \"{}\"}}", type.name,
                          mixture_.kinds().front().solid->name())
            : "use the solid of the file in /sweep/solid");
  }

  const Mixture& mixture_;
  const TypeNames& names_;
  std::vector<std::string>* notes_;
};

/// The solids of the types that particles have.
std::vector<Match> matches_of(const ForeignPacking& foreign, const Matching& matching) {
  std::vector<char> used(foreign.types.size(), 0);
  for (const auto& body : foreign.bodies) used[static_cast<std::size_t>(body.type)] = 1;
  std::vector<Match> matches;
  for (std::size_t t = 0; t < foreign.types.size(); ++t)
    matches.push_back(used[t] ? matching.match_of(foreign.types[t]) : Match{});
  return matches;
}

void note_other_names(const ForeignPacking& foreign, const TypeNames& names, std::vector<std::string>& notes) {
  for (const auto& [name, solid] : names) {
    if (std::ranges::find(foreign.types, name, &ForeignPacking::Type::name) == foreign.types.end())
      notes.push_back(fmt::format("it has no type {}, which /start/types names", in_quotes(name)));
  }
}

/// The mixture's particles in the order of the file's particles. Sizes of one solid are assigned in order of size.
std::vector<Particle> assigned(const Mixture& mixture, const std::vector<Particle>& in_file) {
  auto own = mixture.particles(static_cast<int>(in_file.size()));
  const auto before = [](const Particle& a, const Particle& b) {
    return std::pair(a.unit->name(), a.scale) < std::pair(b.unit->name(), b.scale);
  };
  std::stable_sort(own.begin(), own.end(), before);
  std::vector<std::size_t> order(in_file.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return before(in_file[a], in_file[b]); });
  auto result = in_file;
  for (std::size_t k = 0; k < order.size(); ++k) {
    auto& particle = result[order[k]];
    if (particle.unit != own[k].unit || !(std::abs(particle.scale - own[k].scale) <= size_tolerance * own[k].scale))
      throw ContentError(fmt::format(
          "its {} particles do not match {}: one is a {} of size {:.6g} instead of a {} of size {:.6g}", in_file.size(),
          to_string(mixture), particle.unit->name(), particle.scale, own[k].unit->name(), own[k].scale));
    particle = own[k];
  }
  return result;
}

PeriodicCell cell_of(const Eigen::Matrix3d& vectors) {
  const double side = vectors(0, 0);
  const Eigen::Matrix3d cube = side * Eigen::Matrix3d::Identity();
  // In single precision the sides of a cube may differ by rounding, and tilts of 0 may become small numbers.
  if ((vectors - cube).cwiseAbs().maxCoeff() <= 1e-6 * std::abs(side)) return PeriodicCell(side);
  DoubleDoubleMatrix cell;
  cell.high = vectors;
  return PeriodicCell(cell);
}

}  // namespace

Eigen::Quaterniond unit_quaternion(const Eigen::Quaterniond& q, std::size_t particle, std::string_view order,
                                   std::size_t line) {
  constexpr double rounding = 1e-3;
  // Written so that NaN is refused too.
  if (!(std::abs(q.norm() - 1) <= rounding))
    throw ContentError(fmt::format("the orientation of particle {} has the length {:.6g}", particle, q.norm()),
                       fmt::format("write unit quaternions {}", order), line);
  return q.normalized();
}

std::size_t index_of_frame(std::size_t frames, int frame) {
  const auto count = static_cast<std::int64_t>(frames), index = frame < 0 ? count + frame : frame;
  if (count == 0) throw ContentError("the file has no frame");
  if (index < 0 || index >= count)
    throw ContentError(
        fmt::format("the file has {} {}, but /start/frame is {}", count, count == 1 ? "frame" : "frames", frame),
        count == 1 ? "set it to 0" : fmt::format("set it to a value from 0 to {}", count - 1));
  return static_cast<std::size_t>(index);
}

Packing packing_of(const ForeignPacking& foreign, const Mixture& mixture, const TypeNames& types,
                   std::vector<std::string>* notes) {
  if (notes) note_other_names(foreign, types, *notes);
  const auto matches = matches_of(foreign, {mixture, types, notes});
  std::vector<Particle> particles;
  double volume = 0;
  for (const auto& body : foreign.bodies) {
    const auto& match = matches[static_cast<std::size_t>(body.type)];
    particles.push_back({match.solid, body.size * match.place.scale});
    volume += cubed(particles.back().scale);
  }
  const double unit = nearest::cbrt(volume / static_cast<double>(particles.size()));
  if (!std::isfinite(unit) || !(unit > 0)) throw ContentError("the sizes of its particles overflow or underflow");
  for (auto& particle : particles) particle.scale /= unit;
  try {
    Packing packing{Composition(assigned(mixture, particles)), cell_of(foreign.cell / unit), {}};
    for (const auto& body : foreign.bodies) {
      const auto& place = matches[static_cast<std::size_t>(body.type)].place;
      Pose pose;
      pose.position = (body.position + body.orientation * (body.size * place.shift)) / unit;
      pose.orientation = (body.orientation * place.rotation).normalized();
      // Written so that NaN is refused too.
      if (!(packing.cell.fractional(pose.position).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= most_cells))
        throw ContentError(
            fmt::format("particle {} is more than {} cells away from the origin", packing.size(), most_cells));
      packing.poses.push_back(pose);
    }
    return packing;
  } catch (const std::invalid_argument& error) {
    throw ContentError(fmt::format("its cell is not valid: {}", error.what()));
  }
}

}  // namespace isojam
