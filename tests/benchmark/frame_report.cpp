#include "tests/benchmark/frame_report.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/core/check.h"
#include "tests/benchmark/processor.h"

namespace rowland::benchmark {

namespace {

const FrameResult& find(const FrameReport& report, const std::string& name) {
    const auto found = std::find_if(report.results.begin(), report.results.end(),
                                    [&](const FrameResult& result) { return result.name == name; });
    ROWLAND_CHECK(found != report.results.end(), "a baseline that was not drawn");
    return *found;
}

}  // namespace

double FrameReport::ratio(const FrameResult& result) const {
    return result.minimum_ms / find(*this, result.baseline).minimum_ms;
}

double FrameReport::work_ratio(const FrameResult& result) const {
    return result.work_ms / find(*this, result.baseline).work_ms;
}

FrameReport describe_machine(const platform::HeadlessContext& context) {
    FrameReport report;
    report.processor = processor_name();
    report.threads = std::thread::hardware_concurrency();
    report.vendor = reinterpret_cast<const char*>(glGetString(GL_VENDOR));
    report.renderer = context.renderer();
    report.version = context.version();
    report.software = context.is_software();
    return report;
}

std::string to_text(const FrameReport& report) {
    std::string text = fmt::format(
        "{} ({} threads); {}, {}\n"
        "{}x{}, disc over {:.0f} % of the picture, sky on, minima of {} interleaved rounds\n",
        report.processor, report.threads, report.renderer, report.version, report.size.x, report.size.y,
        100.0 * report.coverage, report.rounds);
    text += fmt::format("{:<36} {:>9} {:>9} {:>8} {:>10} {:>8}  {}\n", "frame", "ms", "median", "ratio",
                        report.software ? "threads ms" : "GPU ms", "ratio", "to");
    for (const FrameResult& result : report.results)
        text += fmt::format("{:<36} {:>9.2f} {:>9.2f} {:>8.3f} {:>10.2f} {:>8.3f}  {}\n", result.name,
                            result.minimum_ms, result.median_ms, report.ratio(result), result.work_ms,
                            report.work_ratio(result), result.baseline);
    return text;
}

std::string to_json(const FrameReport& report) {
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    for (const FrameResult& result : report.results) {
        nlohmann::ordered_json frame = {{"name", result.name},
                                        {"minimum_ms", result.minimum_ms},
                                        {"median_ms", result.median_ms},
                                        {"baseline", result.baseline},
                                        {"ratio", report.ratio(result)},
                                        {"work_ms", result.work_ms},
                                        {"work_ratio", report.work_ratio(result)},
                                        {"mean_radiance", result.mean_radiance}};
        frames.push_back(std::move(frame));
    }
    const nlohmann::ordered_json json = {{"processor", report.processor},
                                         {"threads", report.threads},
                                         {"gl_vendor", report.vendor},
                                         {"gl_renderer", report.renderer},
                                         {"gl_version", report.version},
                                         {"software", report.software},
                                         {"width", report.size.x},
                                         {"height", report.size.y},
                                         {"rounds", report.rounds},
                                         {"coverage", report.coverage},
                                         {"frames", frames}};
    return json.dump(2) + "\n";
}

std::string file_name_of(const std::string& renderer) {
    std::string name;
    for (const char c : renderer) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (plain)
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    if (!name.empty() && name.back() == '-') name.pop_back();
    return name;
}

}  // namespace rowland::benchmark
