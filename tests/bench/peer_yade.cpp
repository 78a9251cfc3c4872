#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/bench/peers.hpp"

namespace isojam::bench {

namespace {

namespace fs = std::filesystem;

void write_vector(std::ostream& out, const Eigen::Vector3d& v) { out << v.x() << ' ' << v.y() << ' ' << v.z() << ' '; }

/// The side of the cube, and one line for each particle: its centre, and its rotated vertices.
void write_packing(const fs::path& path, const Packing& packing) {
  std::ofstream out(path);
  out.precision(17);
  out << std::cbrt(packing.cell.volume()) << '\n';
  for (std::size_t k = 0; k < packing.poses.size(); ++k) {
    write_vector(out, packing.poses[k].position);
    const Eigen::Matrix3d rotation = rotation_matrix(packing.poses[k]).high;
    for (const Eigen::Vector3d& vertex : packing.solids.only().vertices()) write_vector(out, rotation * vertex);
    out << '\n';
  }
}

}  // namespace

YadeStep yade_step(const Packing& packing) {
  std::string folder = (fs::temp_directory_path() / "isojam-yade-XXXXXX").string();
  if (!mkdtemp(folder.data())) throw std::runtime_error("no temporary directory");
  write_packing(folder + "/packing", packing);
  const std::string command =
      "cd " + folder + " && yade -j1 -n -x " ISOJAM_YADE_SCRIPT " packing result >/dev/null 2>&1";
  const int code = std::system(command.c_str());
  YadeStep step;
  std::ifstream in(folder + "/result");
  in >> step.seconds >> step.left;
  for (YadeContact c; in >> c.a >> c.b >> c.volume >> c.force.x() >> c.force.y() >> c.force.z();)
    step.contacts.push_back(c);
  fs::remove_all(folder);
  if (code != 0 || step.contacts.empty()) throw std::runtime_error("yade failed: " + command);
  return step;
}

}  // namespace isojam::bench
