#include "editor/trade/inputs.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/number_table.h"
#include "engine/math/sh_basis.h"

namespace rowland::trade {

namespace {

[[noreturn]] void fail(const NumberTable& table, std::size_t i, std::string found, std::string expected) {
    refuse_input(table.file, fmt::format("row {}", table.file_rows[i]), std::move(found), std::move(expected));
}

}  // namespace

std::vector<diffraction::ShadingPoint> read_frames(const std::filesystem::path& path) {
    const NumberTable table = read_number_table(path, "vx,vy,vz,nx,ny,nz,gx,gy,gz");
    std::vector<diffraction::ShadingPoint> frames;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& x = table.rows[i];
        frames.push_back({.view = {x[0], x[1], x[2]}, .normal = {x[3], x[4], x[5]}, .grating = {x[6], x[7], x[8]}});
        if (!is_valid(frames.back()))
            fail(table, i, "a frame without three directions", "v, n and g other than 0, and g not along n");
    }
    return frames;
}

lighting::ShLight read_sh_light(const std::filesystem::path& path) {
    const NumberTable table = read_number_table(path, "l,m,r,g,b");
    const int bands = static_cast<int>(std::lround(std::sqrt(static_cast<double>(table.rows.size()))));
    if (table.rows.empty() || static_cast<std::size_t>(math::sh_count(bands)) != table.rows.size() ||
        bands > math::kMaximumBands)
        throw Error(
            {.file = table.file,
             .location = {},
             .found = fmt::format("{} rows", table.rows.size()),
             .expected = fmt::format("n² rows, one for every l < n and -l <= m <= l, n <= {}", math::kMaximumBands),
             .remedy = "rowland-trade project writes such a table"});
    std::vector<std::optional<glm::dvec3>> found(table.rows.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const auto& x = table.rows[i];
        const bool whole = x[0] == std::floor(x[0]) && x[1] == std::floor(x[1]);
        if (!whole || x[0] < 0.0 || x[0] >= bands || std::abs(x[1]) > x[0])
            fail(table, i, fmt::format("l = {}, m = {}", x[0], x[1]),
                 fmt::format("whole numbers 0 <= l < {}, -l <= m <= l", bands));
        auto& slot = found[static_cast<std::size_t>(math::sh_index(static_cast<int>(x[0]), static_cast<int>(x[1])))];
        if (slot) fail(table, i, fmt::format("l = {}, m = {} again", x[0], x[1]), "every (l, m) once");
        slot = glm::dvec3(x[2], x[3], x[4]);
    }
    // As many rows as coefficients, all different: every coefficient is set.
    lighting::ShLight light{.bands = bands, .coefficients = {}};
    for (const auto& coefficient : found) light.coefficients.push_back(*coefficient);
    return light;
}

lighting::ProbeImage read_probe(const std::filesystem::path& path, const std::string& mapping) {
    return lighting::load_probe_image(path, lighting::parse_mapping(mapping));
}

}  // namespace rowland::trade
