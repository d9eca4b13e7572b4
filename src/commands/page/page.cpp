#include "commands/page/page.h"

#include <array>
#include <stdexcept>
#include <string_view>

#include <nlohmann/json.hpp>

#include "commands/page/page_template.h"
#include "commands/page/scene_json.h"
#include "commands/shared_options.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/gzip.h"
#include "ibmfair/page/base64.h"

namespace ibmfair::commands {

namespace {

/// JSON text that cannot contain the end tag of a script.
std::string script_json(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : line_of(json)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

void require_page() {
  if (page_template().empty()) {
    throw BadOption(
        "this build has no report page: build it on a machine with npm, or with -D "
        "IBMFAIR_REPORT_PAGE=FILE");
  }
}

std::string page_text(const nlohmann::ordered_json& report, const std::optional<Scene>& scene) {
  const std::array<std::string_view, 3> marks{"@IBMFAIR_REPORT@", "@IBMFAIR_SCENE@",
                                              "@IBMFAIR_BYTES@"};
  const std::array<std::string, 3> texts{
      script_json(report), script_json(scene ? scene_json(*scene) : nlohmann::ordered_json()),
      scene ? base64(gzip(scene->arrays.bytes())) : ""};
  // All marks are replaced in one pass, because an inserted text may contain the text of a mark.
  std::string text;
  std::string_view rest = page_template();
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const std::size_t place = rest.find(marks[i]);
    if (place == std::string_view::npos) {
      throw std::logic_error("the report page lacks a placeholder, or has them in another order");
    }
    text += rest.substr(0, place);
    text += texts[i];
    rest.remove_prefix(place + marks[i].size());
  }
  return text += rest;
}

}  // namespace ibmfair::commands
