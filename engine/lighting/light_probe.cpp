#include "engine/lighting/light_probe.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/byte_stream.h"
#include "engine/core/check.h"
#include "engine/math/sh_basis.h"

namespace rowland::lighting {

namespace {

/// A cube map's faces are at most this in a file; prefiltering makes none larger than 1024.
constexpr std::uint32_t kMaximumFace = 8192;

ShLight read_sh(ByteReader& reader) {
    const auto bands = reader.value<std::uint32_t>();
    if (bands < 1 || bands > math::kMaximumBands)
        reader.fail(fmt::format("{} bands", bands), fmt::format("1 to {}", math::kMaximumBands));
    const auto values = reader.array<double>();
    const std::size_t count = std::size_t{bands} * bands;
    if (values.size() != 3 * count)
        reader.fail(fmt::format("{} SH values", values.size()), fmt::format("{} for {} bands", 3 * count, bands));
    ShLight light{static_cast<int>(bands), std::vector<glm::dvec3>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        light.coefficients[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(light.coefficients[i][c])) reader.fail("an SH value that is not finite", "numbers");
    }
    return light;
}

PackedEnvironmentMap read_environment(ByteReader& reader) {
    PackedEnvironmentMap map;
    const auto size = reader.value<std::uint32_t>();
    const auto levels = reader.value<std::uint32_t>();
    if (!std::has_single_bit(size) || size > kMaximumFace || levels < 1 ||
        levels > static_cast<std::uint32_t>(std::bit_width(size)))
        reader.fail(fmt::format("{} levels of faces of {} texels", levels, size), "a power of two and its levels");
    map.layout = {static_cast<int>(size), static_cast<int>(levels)};
    map.scale = reader.value<float>();
    if (!(std::isnormal(map.scale) && map.scale > 0)) reader.fail("a scale that is no positive number", "a scale");
    map.halves = reader.array<std::uint16_t>();
    const std::size_t expected = 3 * map.layout.offset(map.layout.levels);
    if (map.halves.size() != expected)
        reader.fail(fmt::format("{} environment values", map.halves.size()), fmt::format("{}", expected));
    constexpr std::uint16_t kInfinity = 0x7c00;  // greater bits are NaN or negative
    for (const std::uint16_t bits : map.halves)
        if (bits >= kInfinity) reader.fail("an environment value that is no light", "finite values >= 0");
    return map;
}

glm::dvec3 mean_radiance(const ShLight& light) {
    return light.coefficients[0] / std::sqrt(4 * std::numbers::pi);
}

}  // namespace

LightProbe build_light_probe(const ProbeImage& probe, const LightProbeSettings& settings) {
    LightProbe light;
    light.sh = project(probe, settings.bands);
    light.ambient = ambient_coefficients(light.sh);
    light.environment = pack(prefilter(probe, settings.prefilter));
    light.report = probe.report();
    return light;
}

std::vector<std::byte> serialise(const LightProbe& probe) {
    ROWLAND_CHECK_OP(probe.sh.coefficients.size(), ==, static_cast<std::size_t>(math::sh_count(probe.sh.bands)));
    ByteWriter writer;
    writer.value(static_cast<std::uint32_t>(probe.sh.bands));
    std::vector<double> values;
    for (const glm::dvec3& c : probe.sh.coefficients) values.insert(values.end(), {c.x, c.y, c.z});
    writer.array(std::span<const double>(values));
    writer.value(static_cast<std::uint32_t>(probe.environment.layout.face_size));
    writer.value(static_cast<std::uint32_t>(probe.environment.layout.levels));
    writer.value(probe.environment.scale);
    writer.array(std::span<const std::uint16_t>(probe.environment.halves));
    writer.value(probe.report.nan);
    writer.value(probe.report.infinite);
    writer.value(probe.report.negative);
    return writer.take();
}

LightProbe deserialise(std::span<const std::byte> bytes, const std::string& file) {
    ByteReader reader(bytes, file);
    LightProbe probe;
    probe.sh = read_sh(reader);
    probe.environment = read_environment(reader);
    probe.report.nan = reader.value<std::uint64_t>();
    probe.report.infinite = reader.value<std::uint64_t>();
    probe.report.negative = reader.value<std::uint64_t>();
    if (reader.remaining() != 0) reader.fail(fmt::format("{} bytes too many", reader.remaining()), "the end");
    probe.ambient = ambient_coefficients(probe.sh);
    return probe;
}

std::string describe(const LightProbe& probe) {
    const AmbientWindow& window = probe.ambient.window;
    const glm::dvec3 mean = mean_radiance(probe.sh);
    const CubeLayout& layout = probe.environment.layout;
    std::string text =
        fmt::format("bands: {} ({} coefficients a channel)\n", probe.sh.bands, probe.sh.coefficients.size());
    text += fmt::format("mean radiance: {:.6g} {:.6g} {:.6g}\n", mean.x, mean.y, mean.z);
    text += window.damping > 0 ? fmt::format("ambient window: exponential, damping {:.4g}\n", window.damping)
                               : fmt::format("ambient window: {}\n", math::window_name(window.window));
    text += fmt::format("environment: {} x {} x 6, {} levels, half floats times {:g}\n", layout.face_size,
                        layout.face_size, layout.levels, probe.environment.scale);
    text += fmt::format("texels that were no light: {} (NaN {}, infinite {}, negative {})\n", probe.report.total(),
                        probe.report.nan, probe.report.infinite, probe.report.negative);
    return text;
}

}  // namespace rowland::lighting
