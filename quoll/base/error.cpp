#include "quoll/base/error.hpp"

namespace quoll {

std::string message(const Error& error) {
  std::string text;
  if (!error.file.empty()) {
    text += error.file;
    if (error.line > 0) text += ":" + std::to_string(error.line);
    if (error.line > 0 && error.column > 0) text += ":" + std::to_string(error.column);
    text += ": ";
  }
  text += error.expected;
  if (!error.nearest.empty()) text += "; did you mean '" + error.nearest + "'?";
  return text;
}

}  // namespace quoll
