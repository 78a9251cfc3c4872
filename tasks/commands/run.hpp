#pragma once

#include <string>

#include "tasks/manifest/shard.hpp"

namespace isojam {

/// What `run` and its dry run are told.
struct RunArguments {
  std::string manifest;
  std::string directory;  ///< empty: results/<name of the manifest>
  int threads = 0;        ///< 0: as many as the machine gives this process
  double memory_gib = 0;  ///< for replicates in flight; 0: what is available
  Shard shard;
  bool dry_run = false;
};

}  // namespace isojam
