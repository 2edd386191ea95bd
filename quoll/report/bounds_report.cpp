#include "quoll/report/bounds_report.hpp"

#include <algorithm>

#include "quoll/base/text.hpp"

namespace quoll {

BoundsReport bounds_report(const Certifier& certifier) {
  const ExperienceCertificate& found = certifier.certificate();
  BoundsReport report;
  report.lower = found.start_lower;
  report.upper = found.start_upper;
  report.gap = found.gap;
  if (!certifier.certain()) report.confidence = certifier.goal().confidence;
  report.assumptions = certifier.assumptions();
  return report;
}

std::string certainty_text(const BoundsReport& report) {
  if (!report.confidence) return "the world being deterministic";
  return "with " + shortest(100.0 * *report.confidence) + " % confidence";
}

std::string blocking_text(const BoundsReport& report) {
  constexpr std::size_t most_told = 5;
  if (report.blocking.empty()) return "";
  std::string text;
  for (std::size_t i = 0; i < std::min(report.blocking.size(), most_told); ++i) {
    const NamedBlocking& pair = report.blocking[i];
    text += (i == 0 ? "Blocked by (" : ", (") + pair.state + ", " + pair.action + ") tried " +
            counted(pair.tried, "time");
  }
  return text + "; about " + grouped(report.needed) + " more samples are needed.\n";
}

std::string assumed_text(const BoundsReport& report) {
  if (report.assumptions.empty()) return "";
  std::string text;
  for (const std::string& one : report.assumptions) {
    text += (text.empty() ? "Assumed: " : "; ") + one;
  }
  return text + ".\n";
}

void write_bounds(JsonWriter& json, const std::optional<BoundsReport>& report) {
  if (!report) {
    json.null_member("certificate");
    return;
  }
  json.key("certificate").begin_object();
  json.member("lower", report->lower).member("upper", report->upper).member("gap", report->gap);
  if (report->reached) json.member("reached", *report->reached);
  json.member("basis", report->by_model     ? "model"
                       : report->confidence ? "experience-confidence"
                                            : "experience-deterministic");
  json.member("confidence", report->confidence);
  json.key("assumptions").begin_array();
  for (const std::string& one : report->assumptions) json.value(one);
  json.end_array();
  if (report->reached) {
    json.key("blocking").begin_array();
    for (const NamedBlocking& pair : report->blocking) {
      json.begin_object().member("state", pair.state).member("action", pair.action);
      json.member("visits", pair.tried).member("needed", pair.needed).end_object();
    }
    json.end_array();
  }
  json.end_object();
}

}  // namespace quoll
