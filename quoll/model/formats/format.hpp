#pragma once
// File formats of models: one file per format, one line each in the registry.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "quoll/base/parameters.hpp"
#include "quoll/model/mdp.hpp"

namespace quoll {

/// One of the files a model is written as.
struct WrittenFile {
  std::string path;
  std::string content;
};

/// Readers hand out arrays that fit together but may still hold what Mdp::make refuses (a row that
/// sums to 0.9, a reward that is not a number), so that check can report all of it at once.
struct Format {
  std::string_view name;       ///< "toml"
  std::string_view extension;  ///< ".toml"
  std::string_view summary;
  /// Parses the content of a file; `path` is for messages. Nullptr = cannot be read like this.
  Result<MdpArrays> (*read_arrays)(std::string_view content, const std::string& path);
  /// The model as text that read_arrays() takes back; nullptr = cannot be written.
  Result<std::string> (*write)(const Mdp& mdp);
  /// Reads a file piece by piece, for formats whose files may be larger than memory has room for
  /// twice, or of which several make a model; nullptr = read whole, then parsed.
  Result<MdpArrays> (*read_path)(const std::string& path, const Parameters& given);
  /// Instead of read_arrays for formats that say too little alone, and what --with may set for
  /// them; nullptr = no parameters.
  Result<MdpArrays> (*read_with)(std::string_view content, const std::string& path,
                                 const Parameters& given) = nullptr;
  std::vector<ParameterText> (*parameters)() = nullptr;
  /// Instead of write for formats of several files: the one at `path` first, its companions, which
  /// a reader finds beside it, after it.
  Result<std::vector<WrittenFile>> (*write_files)(const Mdp& mdp,
                                                  const std::string& path) = nullptr;
};

/// All formats, a hand-written constant table.
std::span<const Format> formats();

/// The format of a file name by its extension; an Error lists the known ones.
Result<const Format*> format_of(const std::string& path);

/// Reads a model file by its extension. Errors as one line, file:line:column.
Result<Mdp> read_model(const std::string& path, const Parameters& given = {});
/// The same before validation.
Result<MdpArrays> read_model_arrays(const std::string& path, const Parameters& given = {});
/// The model in `content`, whose format and name in messages `path` gives; opens no file but those
/// that the content or the parameters name.
Result<Mdp> parse_model(std::string_view content, const std::string& path,
                        const Parameters& given = {});
Result<MdpArrays> parse_model_arrays(std::string_view content, const std::string& path,
                                     const Parameters& given = {});

/// The files of a model in the format of `path`, which is the first of them; writes none. An Error
/// if that format cannot be written, or not this model.
Result<std::vector<WrittenFile>> write_model(const Mdp& mdp, const std::string& path);

/// Refuses a model with a name that no reader would take back (quoll/model/letters.hpp).
Result<void> proper_names(const Mdp& mdp);
/// Refuses a model in which two players move in turn, for formats that know one.
Result<void> one_player(const Mdp& mdp);

/// Refuses names of labels and rewards with quotation marks, for formats that put them between
/// some.
Result<void> quotable_names(const Mdp& mdp);

Result<MdpArrays> read_toml(std::string_view content, const std::string& path);
Result<std::string> write_toml(const Mdp& mdp);

Result<MdpArrays> read_csv(std::string_view content, const std::string& path);
Result<MdpArrays> read_csv_path(const std::string& path, const Parameters& given);
Result<std::string> write_csv(const Mdp& mdp);

Result<MdpArrays> read_grid(std::string_view content, const std::string& path);
Result<std::string> write_grid(const Mdp& mdp);

/// Explicit files of PRISM and Storm; their parts: quoll/model/formats/prism.hpp.
Result<MdpArrays> read_prism(std::string_view content, const std::string& path,
                             const Parameters& given);
Result<MdpArrays> read_prism_path(const std::string& path, const Parameters& given);
std::vector<ParameterText> prism_parameters();
Result<std::vector<WrittenFile>> write_prism(const Mdp& mdp, const std::string& path);

Result<MdpArrays> read_drn(std::string_view content, const std::string& path);
Result<MdpArrays> read_drn_path(const std::string& path, const Parameters& given);
Result<std::string> write_drn(const Mdp& mdp);

/// Unified Markov Binary (github.com/pmc-tools/umb, spec.md): docs/formats.md says what Quoll adds.
Result<MdpArrays> read_umb(std::string_view content, const std::string& path);
Result<MdpArrays> read_umb_path(const std::string& path, const Parameters& given);
Result<std::string> write_umb(const Mdp& mdp);

/// Gymnasium's env.P as JSON.
Result<MdpArrays> read_gymnasium(std::string_view content, const std::string& path);
Result<std::string> write_gymnasium(const Mdp& mdp);

/// Cassandra's format; without observations in a .mdp, with the states themselves in a .pomdp.
Result<MdpArrays> read_cassandra(std::string_view content, const std::string& path);
Result<std::string> write_cassandra_mdp(const Mdp& mdp);
Result<std::string> write_cassandra_pomdp(const Mdp& mdp);

/// PETSc's binary matrices: transitions in the file itself, rewards in the one that --with names.
Result<MdpArrays> read_petsc(std::string_view content, const std::string& path,
                             const Parameters& given);
std::vector<ParameterText> petsc_parameters();

/// Maps for robots; settings and model: quoll/model/terrain.hpp.
Result<MdpArrays> read_moving_ai(std::string_view content, const std::string& path,
                                 const Parameters& given);
std::vector<ParameterText> moving_ai_parameters();
Result<MdpArrays> read_ros_map(std::string_view content, const std::string& path,
                               const Parameters& given);
Result<MdpArrays> read_pgm_map(std::string_view content, const std::string& path,
                               const Parameters& given);
std::vector<ParameterText> ros_map_parameters();

}  // namespace quoll
