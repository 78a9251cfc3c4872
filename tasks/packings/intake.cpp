#include "tasks/packings/intake.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/arithmetic/elementary.hpp"
#include "engine/geometry/hull.hpp"
#include "tasks/packings/solid_json.hpp"
#include "tasks/packings/surface.hpp"

namespace isojam {
namespace {

/// Larger deviations are not those of rounded numbers.
constexpr double largest_rounding = 1e-3;

/// The hull of a surface without dents. Points that are not corners lie within the tolerance of its faces, and are
/// omitted.
RepairedSolid corners_of(const Surface& surface, RepairOptions options) {
  options.measures_depth = !options.hull;
  options.hull = true;
  try {
    return repaired(surface.points, options);
  } catch (const NoSolid& error) {
    throw ContentError(error.what(), remedy_for(error, surface.points, options));
  }
}

/// The smallest of the values 1, 2, 5 × 10^k for which the mesh is accepted; nullopt if there is none of the order of
/// the deviation.
std::optional<double> fitting_merge(const Mesh& mesh, RepairOptions options, double deviation) {
  const double decade = nearest::pow(10, std::floor(nearest::log10(deviation)));
  for (const double factor : {1, 2, 5, 10, 20, 50}) {
    options.merge = factor * decade;
    if (options.merge < deviation) continue;
    if (options.merge > largest_merge) break;
    std::optional<Surface> surface;
    try {
      surface = closed_surface(mesh, options.merge);
    } catch (const NoSurface&) {
      continue;
    }
    try {
      corners_of(*surface, options);
      return options.merge;
    } catch (const ContentError&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

Surface checked_surface(const Mesh& mesh, const RepairOptions& options) {
  if (options.hull) return points_of(mesh);
  try {
    return closed_surface(mesh, options.merge);
  } catch (const NoSurface& error) {
    if (error.deviation() <= 0 || error.deviation() > largest_rounding) throw;
    const auto merge = fitting_merge(mesh, options, error.deviation());
    if (!merge) throw;
    throw ContentError(error.what(),
                       fmt::format("set \"merge\" to {:g} to weld corners and join faces that differ by less, or {}",
                                   *merge, error.remedy()),
                       error.line());
  }
}

/// A surface with many shallow dents, or one that covers its hull twice, passes the checks of its edges.
void refuse_other_hull(const Surface& surface, const RepairReport& report, const RepairOptions& options) {
  constexpr std::string_view remedy = "set \"hull\" to true to use the convex hull of the vertices";
  const double tolerance = surface_tolerance(options.merge);
  if (report.largest_depth > tolerance)
    throw ContentError(
        fmt::format("not convex: a vertex is {:.2g} diameters below the convex hull", report.largest_depth),
        std::string(remedy));
  if (std::abs(surface.volume - report.hull_volume) > tolerance * surface.area * surface.diameter)
    throw ContentError(fmt::format("not convex: the faces enclose the volume {:.7g}, and their convex hull {:.7g}",
                                   surface.volume, report.hull_volume),
                       std::string(remedy));
}

}  // namespace

std::string remedy_for(const NoSolid& error, std::span<const Eigen::Vector3d> points, const RepairOptions& options) {
  if (const auto tried = tried_repair(points, options, error.cause())) {
    std::string text;
    const auto add = [&text](const std::string& change) { text += (text.empty() ? "set " : " and ") + change; };
    if (tried->hull && !options.hull) add("\"hull\" to true");
    if (tried->merge > 0 && tried->merge != options.merge) add(fmt::format("\"merge\" to {:g}", tried->merge));
    if (tried->corners != options.corners) add(fmt::format("\"corners\" to {}", tried->corners));
    if (tried->max_volume_change != options.max_volume_change)
      add(fmt::format("\"max_volume_change\" to {:g}", tried->max_volume_change));
    if (tried->merge == 0 && options.merge > 0) text += text.empty() ? "remove \"merge\"" : ", and remove \"merge\"";
    return text;
  }
  if (error.cause() == NoSolid::Cause::not_planar) return "write the vertices with more digits";
  return fmt::format("use {}", allowed_features());
}

Intake solid_in(const Mesh& mesh, const RepairOptions& options) {
  if (mesh.faces.empty() && !(options.hull && !mesh.points.empty()))
    throw ContentError("the file contains no faces",
                       mesh.points.empty() ? "" : "set \"hull\" to true to use the convex hull of its points");
  const auto surface = checked_surface(mesh, options);
  auto result = corners_of(surface, options);
  if (!options.hull) refuse_other_hull(surface, result.report, options);
  Intake intake{std::move(result.vertices), result.report, mesh.notes};
  if (surface.unused > 0)
    intake.notes.insert(intake.notes.begin(),
                        fmt::format("{} {} to no face", surface.unused,
                                    surface.unused == 1 ? "vertex that belongs" : "vertices that belong"));
  return intake;
}

}  // namespace isojam
