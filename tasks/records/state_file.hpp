#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tasks/packings/packing_json.hpp"

namespace isojam {

/// Identifies the record to which a packing file or a path file belongs. Both files begin with this identity. It shows
/// whether an undamaged file belongs to another replicate, or to another run of the same replicate.
struct RecordIdentity {
  std::string replicate;  ///< name of the replicate
  std::string spec_digest, result_digest;
};

/// The first members of a packing file or a path file.
struct StateFileHead {
  std::string schema;
  RecordIdentity identity;
  std::optional<std::string> checksum = std::nullopt;
};
void describe(Fields& field, StateFileHead& head);
/// A packing file, with the nearest state of a replicate.
struct PackingFile {
  StateFileHead head;
  StoredPacking packing;
};
void describe(Fields& field, PackingFile& file);
/// A path file, with all states of the decompression.
struct PathState {
  Reasoned<> delta_phi;
  StoredPacking packing;
};
void describe(Fields& field, PathState& state);
struct PathFile {
  StateFileHead head;
  std::vector<PathState> states;
};
void describe(Fields& field, PathFile& file);

/// Checks a packing file or a path file. `identities` are the identity of its record, and the identities that the
/// record had before measures were added; the file must have one of them. Throws FileError if the file does not exist
/// or cannot be read at the moment. Throws InputError if it is damaged, has another schema, or belongs to another
/// record.
void check_state_file(const std::string& file, std::string_view schema, std::span<const RecordIdentity> identities);

/// Checks a packing file or a path file with check_state_file(), and returns its content.
Json read_state_file(const std::string& file, std::string_view schema, std::span<const RecordIdentity> identities);

}  // namespace isojam
