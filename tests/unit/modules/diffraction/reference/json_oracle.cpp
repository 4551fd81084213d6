#include "tests/unit/modules/diffraction/reference/json_oracle.h"

#include <nlohmann/json.hpp>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction::test {

namespace {

/// The grating of a row: the material's JSON, where metal, cover and transmission lie within the grating.
Grating row_grating(const std::string& text, const std::filesystem::path& file) {
    nlohmann::json json = {{"grating", parse_json(text, file.string())}};
    for (const char* member : {"metal", "cover", "transmission"})
        if (json["grating"].contains(member)) {
            json[member] = json["grating"][member];
            json["grating"].erase(member);
        }
    Grating grating = parse_material(json, file.string()).grating;
    grating.theory = Theory::Scalar;  // which the oracles have
    return grating;
}

}  // namespace

std::vector<JsonCase> read_json_cases(const std::filesystem::path& path) {
    const rowland::test::Csv table = rowland::test::read_csv(path, ';');
    const bool has_light = std::find(table.header.begin(), table.header.end(), "light") != table.header.end();
    const std::vector<ShadingPoint> frames = read_frames(table);
    const std::vector<glm::dvec3> xyz = read_xyz(table);
    std::vector<JsonCase> cases;
    for (std::size_t row = 0; row < frames.size(); ++row) {
        const std::string& name = table.text(row, "case");
        const std::string light = has_light ? table.text(row, "light") : std::string();
        if (cases.empty() || cases.back().name != name || cases.back().light != light)
            cases.push_back({{name, row_grating(table.text(row, "grating"), path), {}, {}}, light});
        cases.back().frames.push_back(frames[row]);
        cases.back().xyz.push_back(xyz[row]);
    }
    return cases;
}

}  // namespace rowland::diffraction::test
