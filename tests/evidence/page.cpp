#include <span>

#include "editor/trade/report.h"
#include "engine/core/text.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

/// page.html: the page without its data.
std::span<const EmbeddedFile> page_files();

const std::vector<Section>& sections() {
    static const std::vector<Section> list = {{.name = "curves", .measure = curves},
                                              {.name = "photographs", .measure = photographs},
                                              {.name = "metals", .measure = metals},
                                              {.name = "peers", .measure = peers},
                                              {.name = "pit_sequence", .measure = pit_sequence},
                                              {.name = "level", .on_request = true, .measure = level}};
    return list;
}

std::string page_html(const Json& measured) {
    return trade::page_with_data(page_files().front().text, measured);
}

}  // namespace rowland::evidence
