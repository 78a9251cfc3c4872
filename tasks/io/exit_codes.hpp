#pragma once

namespace isojam {

enum class ExitCode {
  done = 0,
  /// a replicate failed, a resource (memory, disk, …) ran out, or a file could not be read or written
  some_failed = 1,
  /// the command line has an error; or a path that it names does not exist or is of the wrong kind; or a replicate that
  /// it names does not exist or has no packing; or this build does not have the command
  usage = 2,
  /// a manifest has an error, a file of the results is damaged or missing, or the directory belongs to another manifest
  /// (EX_DATAERR)
  bad_input = 65,
  interrupted = 75,  ///< a signal stopped the program; repeat the same command to resume (EX_TEMPFAIL)
};

}  // namespace isojam
