#pragma once

namespace isojam {

enum class ExitCode {
  done = 0,
  some_failed = 1,  ///< a replicate failed, a resource (memory, disk, …) ran out, or output could not be written
  usage = 2,        ///< the command line has an error, or a path that it names cannot be read or written
  /// a manifest has an error, a record is damaged, or the directory belongs to another manifest (EX_DATAERR)
  bad_input = 65,
  interrupted = 75,  ///< a signal stopped the program; repeat the same command to resume (EX_TEMPFAIL)
};

}  // namespace isojam
