#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tasks/io/json.hpp"

namespace isojam {

/// Identifies the record to which a packing or a path belongs. These files contain this identity at their beginning. It
/// shows whether an undamaged file belongs to another replicate, or to another run of the same replicate.
struct RecordIdentity {
  std::string replicate;  ///< name
  std::string manifest_digest, result_digest;
};

/// Makes the first members of a packing or path file.
Json state_file_head(std::string_view schema, const RecordIdentity& identity);

/// Checks a packing or path file. Throws FileError if it does not exist or cannot be read at the moment. Throws
/// InputError if it is damaged, has another schema, or belongs to another record. `identities` are the present identity
/// of the record, and its earlier identities from before measures were added.
void check_state_file(const std::string& file, std::string_view schema, std::span<const RecordIdentity> identities);

/// Reads a packing or path file, with the checks of check_state_file().
Json read_state_file(const std::string& file, std::string_view schema, std::span<const RecordIdentity> identities);

}  // namespace isojam
