#pragma once
// Certificates as files (docs/certificates.md): a few lines that say what they are about, then one
// line per state with the policy's action and both bounds, as text that a person or another program
// can check as well. Names stand for states and actions; numbers are the shortest digits that read
// back as the same double. There is no checksum: whatever stands there is a claim, and is checked.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quoll/base/error.hpp"
#include "quoll/base/parameters.hpp"
#include "quoll/model/formats/lines.hpp"
#include "quoll/model/mdp.hpp"
#include "quoll/verify/verify.hpp"

namespace quoll {

struct Certificate {
  std::string world;          ///< name of the model; says nothing about its numbers
  Parameters parameters;      ///< with which that world was opened
  std::uint64_t digest = 0;   ///< of the model (quoll/model/digest.hpp)
  double discount = 1.0;      ///< in (0, 1]
  bool maximise = true;       ///< false: rewards are costs
  std::string method;         ///< the solver that found the bounds
  std::vector<double> lower;  ///< per state
  std::vector<double> upper;
  std::vector<Action> policy;  ///< no_action where nothing is said
};

/// The text of a certificate for this model. Error: a name that holds an end of a line.
Result<std::string> certificate_text(const Certificate& certificate, const Mdp& mdp);

/// Whether a file begins as certificates do.
bool is_certificate(const std::string& path);

/// A certificate of which only the lines before the states have been read.
struct OpenCertificate {
  std::string path;
  Certificate content;
  std::uint64_t states = 0;
  Lines lines;
};

/// Error: no readable file, not a certificate, a newer one, a line that does not fit.
Result<OpenCertificate> open_certificate(const std::string& path);
/// The same for a text in memory, which must outlive it; `path` is for messages.
Result<OpenCertificate> open_certificate(std::string_view text, const std::string& path);

/// Reads bounds and policy into `open.content`, in any order of states. Accepted means only that
/// every state of the model is spoken of, by its name and with an action it has; else the verdict
/// names the first state that is not. Error: a line that does not fit, a state that stands twice, a
/// file that is cut. O(length of the file).
Result<Verdict> read_claims(OpenCertificate& open, const Mdp& mdp);

}  // namespace quoll
