#include "tests/evidence/page.h"

#include <span>

#include "engine/core/check.h"
#include "engine/core/text.h"

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

std::string page_html(const Json& sections) {
    constexpr std::string_view kMark = "/*DATA*/";
    std::string page(page_files().front().text);
    std::string text = sections.dump();
    // Nothing in the data may end the script element that holds it.
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    const std::size_t mark = page.find(kMark);
    ROWLAND_CHECK(mark != std::string::npos, "the template has a mark for the data");
    return page.replace(mark, kMark.size(), text);
}

}  // namespace rowland::evidence
