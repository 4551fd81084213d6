#include "editor/trade/report.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "editor/trade/embedded_files.h"
#include "editor/trade/pareto.h"
#include "editor/trade/sweep_tables.h"
#include "engine/core/check.h"
#include "engine/image/png.h"

namespace rowland::trade {

namespace {

constexpr std::size_t kDiscVertices = 25000;
constexpr const char* kDataMark = "/*DATA*/";

std::string base64(std::span<const std::byte> bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t j) { return j < bytes.size() ? std::to_integer<unsigned>(bytes[j]) : 0U; };
        const unsigned triple = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        for (unsigned digit = 0; digit < 4; ++digit)
            text += i + digit > bytes.size() ? '=' : kDigits[triple >> (18U - 6U * digit) & 63U];
    }
    return text;
}

std::string data_url(const RgbPicture& picture) {
    return "data:image/png;base64," + base64(image::encode_png(picture.width, picture.height, 3, picture.rgb));
}

nlohmann::ordered_json to_json(const Curve& curve) {
    return {{"x", curve.x}, {"y", curve.y}};
}

std::size_t memory_of(const CostRow& cost) {
    return cost.cost.table_bytes + cost.vertex_bytes * kDiscVertices;
}

nlohmann::ordered_json panel_row(const SweepResults& results, const ErrorRow& error) {
    const CostRow& cost = cost_of(results, error);
    const Setting& setting = results.settings[error.material][error.setting];
    nlohmann::ordered_json row = {
        {"setting", setting_name(setting)},
        {"representation", representation_of(setting)},
        {"error", error.error.relative_rms},
        {"median_delta_e", error.error.median_delta_e},
        {"p95_delta_e", error.error.high_delta_e},
        {"dark_absolute", error.error.dark_absolute},
        {"fetches_per_vertex", cost.cost.fetches_per_vertex},
        {"multiply_adds_per_vertex", cost.cost.multiply_adds_per_vertex},
        {"fetches_per_pixel", cost.cost.fetches_per_pixel + setting.key_lights * cost.cost.fetches_per_light},
        {"multiply_adds_per_pixel", cost.cost.multiply_adds_per_pixel},
        {"table_bytes", cost.cost.table_bytes},
        {"vertex_bytes", cost.vertex_bytes},
        {"memory", memory_of(cost)}};
    if (cost.time) {
        row["ms"] = cost.time->ms;
        row["ratio"] = cost.time->ratio();
    }
    return row;
}

void mark_front(const char* cost, const char* mark, nlohmann::ordered_json& rows) {
    std::vector<TradePoint> points;
    for (const auto& row : rows)
        points.push_back({row.contains(cost) ? row[cost].get<double>() : std::numeric_limits<double>::infinity(),
                          row["error"].get<double>()});
    for (const std::size_t i : pareto_front(points)) rows[i][mark] = true;
}

nlohmann::ordered_json panels(const SweepResults& results) {
    std::vector<std::tuple<std::size_t, std::size_t, std::string>> order;
    std::map<std::tuple<std::size_t, std::size_t, std::string>, nlohmann::ordered_json> rows;
    for (const ErrorRow& error : results.errors) {
        const auto key = std::tuple(error.material, error.probe, error.set);
        if (!rows.contains(key)) {
            order.push_back(key);
            rows[key] = nlohmann::ordered_json::array();
        }
        rows[key].push_back(panel_row(results, error));
    }
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
        return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
    });
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& key : order) {
        const auto& [material, probe, set] = key;
        mark_front("ratio", "front_speed", rows[key]);
        mark_front("memory", "front_memory", rows[key]);
        list.push_back({{"material", results.materials[material]},
                        {"probe", results.probes[probe]},
                        {"set", set},
                        {"rows", rows[key]}});
    }
    return list;
}

nlohmann::ordered_json paper_json(const PaperEvidence& paper) {
    nlohmann::ordered_json json;
    json["figure_2"] = {{"diffraction", to_json(paper.figure_2.diffraction)},
                        {"interference", to_json(paper.figure_2.interference)},
                        {"peak", to_json(paper.figure_2.peak)},
                        {"peak_width_degrees", paper.figure_2.peak_width_degrees},
                        {"grooves", paper.grooves}};
    if (!paper.figure_3 || !paper.figure_6 || !paper.rates) return json;
    json["figure_3"] = {
        {"lights", paper.figure_3->lights}, {"loop_fps", paper.figure_3->loop_fps}, {"sh_fps", paper.figure_3->sh_fps}};
    json["figure_6"] = {{"direct_one", data_url(paper.figure_6->direct_one)},
                        {"direct_several", data_url(paper.figure_6->direct_several)},
                        {"sh_one", data_url(paper.figure_6->sh_one)},
                        {"sh_several", data_url(paper.figure_6->sh_several)},
                        {"several", paper.figure_6->several}};
    json["rates"] = {{"vertices", paper.rates->vertices},
                     {"plain_fps", paper.rates->plain_fps},
                     {"fps", paper.rates->fps},
                     {"fps_with_effects", paper.rates->fps_with_effects}};
    return json;
}

}  // namespace

std::vector<std::size_t> pictured_settings(const SweepResults& results, std::size_t material, std::size_t probe) {
    const ErrorRow* best = nullptr;
    for (const ErrorRow& row : results.errors) {
        if (row.material != material || row.probe != probe || row.set != "picture") continue;
        const CostRow& cost = cost_of(results, row);
        if (cost.time && cost.time->ratio() > kRealTimeRatio) continue;
        if (best == nullptr || row.error.relative_rms < best->error.relative_rms) best = &row;
    }
    std::vector<std::size_t> settings = {0};
    if (best != nullptr && best->setting != 0) settings.insert(settings.begin(), best->setting);
    return settings;
}

nlohmann::ordered_json report_data(const SweepResults& results, const SweepInputs& inputs,
                                   const std::vector<DifferencePicture>& differences, const PaperEvidence& paper) {
    nlohmann::ordered_json json = {{"device", results.device},
                                   {"frame_size", {inputs.frame_size.x, inputs.frame_size.y}},
                                   {"vertices", kDiscVertices},
                                   {"real_time_ratio", kRealTimeRatio},
                                   {"full_difference", kFullDifference},
                                   {"panels", panels(results)},
                                   {"differences", nlohmann::ordered_json::array()},
                                   {"paper", paper_json(paper)}};
    for (const DifferencePicture& difference : differences)
        json["differences"].push_back(
            {{"group", results.materials[difference.material] + " under " + results.probes[difference.probe]},
             {"setting", difference.setting},
             {"error", difference.error},
             {"image", data_url(difference.picture)}});
    return json;
}

std::string report_html(const nlohmann::ordered_json& data) {
    std::string page(report_files().front().text);
    std::string text = data.dump();
    // Nothing in the data may end the script element that holds it.
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    const std::size_t mark = page.find(kDataMark);
    ROWLAND_CHECK(mark != std::string::npos, "the template has a place for the data");
    return page.replace(mark, std::string(kDataMark).size(), text);
}

}  // namespace rowland::trade
