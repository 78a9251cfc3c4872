#pragma once

namespace isojam {

enum class ExitCode {
  done = 0,
  some_failed = 1,   ///< replicates failed, a resource failure, or output could not be written
  usage = 2,         ///< the command line, or a path on it that cannot be read or written
  bad_input = 65,    ///< a manifest, a record, or a directory of another manifest (EX_DATAERR)
  interrupted = 75,  ///< stopped by a signal; the same command continues (EX_TEMPFAIL)
};

}  // namespace isojam
