#include "engine/lighting/light_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/colour/colour_space.h"
#include "engine/core/byte_stream.h"
#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/lighting/environment_map.h"
#include "engine/math/last_bits.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::lighting {

namespace {

constexpr int kBands = 3;

double band_factor(const AmbientWindow& window, int l) {
    return window.damping > 0 ? math::exponential_window_factor(window.damping, l)
                              : math::window_factor(window.window, l, kBands);
}

AmbientLight convolve(const ShLight& light, const AmbientWindow& window) {
    AmbientLight ambient;
    ambient.window = window;
    for (int l = 0; l < std::min(kBands, light.bands); ++l) {
        const double factor = band_factor(window, l) * math::clamped_cosine_factor(l) / std::numbers::pi;
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<std::size_t>(math::sh_index(l, m));
            ambient.coefficients[i] = factor * light.coefficients[i];
        }
    }
    return ambient;
}

/// A direction in which irradiance must not be negative: basis values, and E/π of the key lights.
struct Trial {
    std::array<double, 9> basis{};
    glm::dvec3 from_keys{0.0};
};

/// Directions spread over the sphere (a Fibonacci spiral). 4096 of them are 3° apart, where three bands vary by less
/// than .5 % of their amplitude around an extremum.
std::vector<Trial> spread_trials(std::span<const KeyLight> keys) {
    constexpr int kCount = 4096;
    const LobeIrradiance irradiance(keys);
    std::vector<Trial> trials(kCount);
    for (int i = 0; i < kCount; ++i) {
        Trial& trial = trials[static_cast<std::size_t>(i)];
        const double z = 1 - (2 * i + 1.0) / kCount;
        const double phi = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
        const double r = std::sqrt(1 - z * z);
        const glm::dvec3 normal(r * std::cos(phi), r * std::sin(phi), z);
        math::evaluate_sh(normal, kBands, trial.basis);
        trial.from_keys = irradiance(normal) / std::numbers::pi;
    }
    return trials;
}

bool is_non_negative(const AmbientLight& ambient, const std::vector<Trial>& trials) {
    // E of a probe that is dark on one side reaches 0, up to rounding.
    const glm::dvec3 tolerance = -1e-12 * glm::abs(ambient.coefficients[0]);
    for (const Trial& trial : trials) {
        glm::dvec3 sum = trial.from_keys;
        for (std::size_t i = 0; i < trial.basis.size(); ++i) sum += trial.basis[i] * ambient.coefficients[i];
        for (int c = 0; c < 3; ++c)
            if (sum[c] < tolerance[c]) return false;
    }
    return true;
}

}  // namespace

AmbientLight ambient_coefficients(const ShLight& light, std::span<const KeyLight> keys) {
    const std::vector<Trial> trials = spread_trials(keys);
    for (const auto window :
         {math::SphericalWindow::None, math::SphericalWindow::Lanczos, math::SphericalWindow::Hann}) {
        AmbientLight ambient = convolve(light, {window, 0});
        if (is_non_negative(ambient, trials)) return ambient;
    }
    // Damping 4 multiplies band 1 by .0003: nothing can go negative any more.
    for (double damping = 0.25; damping < 4; damping *= 1.25) {
        AmbientLight ambient = convolve(light, {math::SphericalWindow::None, damping});
        if (is_non_negative(ambient, trials)) return ambient;
    }
    return convolve(light, {math::SphericalWindow::None, 64});
}

namespace {

/// Largest face of a cube map in a file; prefilter() makes none larger than 1024.
constexpr std::uint32_t kMaximumFace = 8192;

/// Longest name of an illuminant in a file; a recipe may name a path.
constexpr std::size_t kMaximumIlluminantName = 4096;

/// Least concentration of a key light in a file; fit_key_lights() gives kWidestConcentration or more.
constexpr double kLeastConcentration = 1e-3;

void write_sh(const ShLight& light, ByteWriter& writer) {
    ROWLAND_CHECK_OP(light.coefficients.size(), ==, static_cast<std::size_t>(math::sh_count(light.bands)));
    writer.value(static_cast<std::uint32_t>(light.bands));
    std::vector<double> values;
    for (const glm::dvec3& c : light.coefficients) values.insert(values.end(), {c.x, c.y, c.z});
    writer.array(std::span<const double>(values));
}

float read_scale(ByteReader& reader) {
    const auto scale = reader.value<float>();
    if (!(std::isnormal(scale) && scale > 0)) reader.fail("a scale that is no positive number", "a scale");
    return scale;
}

std::vector<std::uint16_t> read_halves(ByteReader& reader, std::size_t count, const char* what) {
    std::vector<std::uint16_t> halves = reader.array<std::uint16_t>();
    if (halves.size() != count) reader.fail(fmt::format("{} {}", halves.size(), what), fmt::format("{}", count));
    for (const std::uint16_t bits : halves)
        if (bits >= kFirstInvalidHalf)
            reader.fail(fmt::format("{} that are negative or not finite", what), "finite values >= 0");
    return halves;
}

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
    map.scale = read_scale(reader);
    map.halves = read_halves(reader, 3 * map.layout.offset(map.layout.levels), "environment values");
    return map;
}

void write_key_lights(const std::vector<KeyLight>& keys, ByteWriter& writer) {
    std::vector<double> values;
    for (const KeyLight& key : keys) {
        const glm::dvec3& s = key.direction;
        values.insert(values.end(), {s.x, s.y, s.z, key.flux.x, key.flux.y, key.flux.z, key.concentration});
    }
    writer.array(std::span<const double>(values));
}

std::vector<KeyLight> read_key_lights(ByteReader& reader) {
    constexpr std::size_t kNumbers = 7;
    const auto values = reader.array<double>();
    if (values.size() % kNumbers != 0 || values.size() > kNumbers * kMaximumKeyLights)
        reader.fail(fmt::format("{} numbers for key lights", values.size()),
                    fmt::format("{} each of at most {}", kNumbers, kMaximumKeyLights));
    std::vector<KeyLight> keys;
    for (std::size_t i = 0; i < values.size(); i += kNumbers) {
        const double* v = values.data() + i;
        const KeyLight key{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6]};
        // Negated so that NaN fails as well.
        if (!(std::abs(glm::dot(key.direction, key.direction) - 1.0) < 1e-6))
            reader.fail("a key light's direction of another length", "length 1");
        for (int c = 0; c < 3; ++c)
            if (!(key.flux[c] >= 0.0 && key.flux[c] < std::numeric_limits<float>::max()))
                reader.fail(fmt::format("a key light's flux {}", key.flux[c]), "a number >= 0");
        if (!(key.concentration >= kLeastConcentration && key.concentration <= kNarrowestConcentration))
            reader.fail(fmt::format("a key light's concentration {}", key.concentration),
                        fmt::format("{} to {}", kLeastConcentration, kNarrowestConcentration));
        keys.push_back(key);
    }
    return keys;
}

void write_light(const PackedLight& light, ByteWriter& writer) {
    writer.value(static_cast<std::uint32_t>(light.face_size));
    writer.value(light.scale);
    writer.array(std::span<const std::uint16_t>(light.halves));
    writer.array(std::span<const std::uint8_t>(light.positions));
}

PackedLight read_light(ByteReader& reader) {
    PackedLight light;
    const auto size = reader.value<std::uint32_t>();
    if (size > static_cast<std::uint32_t>(kMaximumLightFace))
        reader.fail(fmt::format("light cells of {} a side", size), fmt::format("at most {}", kMaximumLightFace));
    light.face_size = static_cast<int>(size);
    light.scale = read_scale(reader);
    const std::size_t count = std::size_t{6} * size * size;
    light.halves = read_halves(reader, 3 * count, "flux values");
    light.positions = reader.array<std::uint8_t>();
    if (light.positions.size() != 2 * count)
        reader.fail(fmt::format("{} positions of light samples", light.positions.size()), fmt::format("{}", 2 * count));
    return light;
}

void write_illuminant(const colour::Illuminant& illuminant, ByteWriter& writer) {
    writer.text(illuminant.name);
    writer.array(std::span<const double>(illuminant.power.wavelengths_nm()));
    writer.array(std::span<const double>(illuminant.power.values()));
}

colour::Illuminant read_illuminant(ByteReader& reader) {
    std::string name = reader.text();
    if (name.empty() || name.size() > kMaximumIlluminantName)
        reader.fail(fmt::format("an illuminant's name of {} bytes", name.size()),
                    fmt::format("1 to {}", kMaximumIlluminantName));
    std::vector<double> wavelengths_nm = reader.array<double>();
    std::vector<double> power = reader.array<double>();
    if (wavelengths_nm.size() < 2 || wavelengths_nm.size() != power.size())
        reader.fail(fmt::format("{} wavelengths and {} powers", wavelengths_nm.size(), power.size()),
                    "as many powers as wavelengths, at least two");
    for (std::size_t i = 0; i < power.size(); ++i) {
        if (!std::isfinite(wavelengths_nm[i]) || wavelengths_nm[i] <= (i == 0 ? 0.0 : wavelengths_nm[i - 1]))
            reader.fail(fmt::format("wavelength {}", wavelengths_nm[i]), "ascending wavelengths > 0");
        if (!std::isfinite(power[i]) || power[i] < 0.0) reader.fail(fmt::format("power {}", power[i]), "a power >= 0");
    }
    colour::Illuminant illuminant{
        .name = std::move(name),
        .power = colour::SampledSpectrum(std::move(wavelengths_nm), std::move(power), colour::Outside::Zero)};
    if (!colour::is_visible(illuminant)) reader.fail("an illuminant without visible power", "visible power");
    return illuminant;
}

void write_dome(const std::optional<CaptureDome>& dome, ByteWriter& writer) {
    writer.value(dome ? dome->height_m : 0.0);
    writer.value(dome ? dome->radius_m : 0.0);
}

/// A height and a radius of 0 are no dome.
std::optional<CaptureDome> read_dome(ByteReader& reader) {
    const auto height_m = reader.value<double>();
    const auto radius_m = reader.value<double>();
    if (height_m == 0.0 && radius_m == 0.0) return std::nullopt;
    // Negated so that NaN fails as well.
    if (!(height_m > 0.0 && height_m < radius_m && radius_m <= kLargestDome_m))
        reader.fail(fmt::format("a dome {} m high and {} m wide", height_m, radius_m),
                    fmt::format("0 < height < radius <= {}", kLargestDome_m));
    return CaptureDome{height_m, radius_m};
}

std::string describe_key_lights(const LightProbe& probe) {
    if (probe.key_lights.empty()) return "key lights: none\n";
    double flux = 0.0;
    for (const KeyLight& key : probe.key_lights) flux += colour::luminance(key.flux);
    const double whole = colour::luminance(probe.sh.coefficients[0]) * std::sqrt(4 * std::numbers::pi);
    const KeyLight& first = *std::ranges::max_element(probe.key_lights, {},
                                                      [](const KeyLight& key) { return colour::luminance(key.flux); });
    return fmt::format(
        "key lights: {}, {:.3g} % of the flux\n"
        "strongest key light: direction {:.4f} {:.4f} {:.4f}, flux {:.6g} {:.6g} {:.6g}, concentration {:.4g}\n",
        probe.key_lights.size(), whole > 0.0 ? 100.0 * flux / whole : 0.0, first.direction.x, first.direction.y,
        first.direction.z, first.flux.x, first.flux.y, first.flux.z, first.concentration);
}

glm::dvec3 mean_radiance(const ShLight& light) {
    return light.coefficients[0] / std::sqrt(4 * std::numbers::pi);
}

/// Throws Error (input) if a component is above kLargestRadiance: sums over the image are in single precision.
void require_finite_sums(const ProbeImage& probe) {
    const image::Image& image = probe.image();
    const auto width = static_cast<std::size_t>(image.width);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const glm::vec3& texel = image.texels[i];
        if (const float largest = std::max({texel.x, texel.y, texel.z}); largest > kLargestRadiance)
            refuse_input(probe.file(), fmt::format("column {}, row {}", i % width, i / width),
                         fmt::format("a radiance of {:.3g}", largest),
                         fmt::format("at most {:.0g}, so that sums over the image are finite", kLargestRadiance),
                         "scale the image down");
    }
}

}  // namespace

LightProbe build_light_probe(const ProbeImage& probe, const LightProbeSettings& settings) {
    require_finite_sums(probe);
    LightProbe light;
    light.sh = project(probe, settings.bands);
    math::drop_last_bits({&light.sh.coefficients.front().x, 3 * light.sh.coefficients.size()});
    light.illuminant = settings.illuminant;
    light.ambient = ambient_coefficients(light.sh);
    light.key_lights = fit_key_lights(probe, settings.key_lights, settings.key_light_fit);
    light.light = pack(bin_into_cells(probe, settings.light_face), settings.light_face);
    light.environment = pack(prefilter(probe, settings.prefilter));
    light.dome = settings.dome;
    light.report = probe.report();
    return light;
}

std::vector<std::byte> serialise(const LightProbe& probe) {
    ByteWriter writer;
    write_sh(probe.sh, writer);
    write_illuminant(probe.illuminant, writer);
    write_key_lights(probe.key_lights, writer);
    write_light(probe.light, writer);
    writer.value(static_cast<std::uint32_t>(probe.environment.layout.face_size));
    writer.value(static_cast<std::uint32_t>(probe.environment.layout.levels));
    writer.value(probe.environment.scale);
    writer.array(std::span<const std::uint16_t>(probe.environment.halves));
    write_dome(probe.dome, writer);
    writer.value(probe.report.nan);
    writer.value(probe.report.infinite);
    writer.value(probe.report.negative);
    return writer.take();
}

LightProbe deserialise(std::span<const std::byte> bytes, const std::string& file) {
    ByteReader reader(bytes, file);
    LightProbe probe;
    probe.sh = read_sh(reader);
    probe.illuminant = read_illuminant(reader);
    probe.key_lights = read_key_lights(reader);
    probe.light = read_light(reader);
    probe.environment = read_environment(reader);
    probe.dome = read_dome(reader);
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
        fmt::format("bands: {} ({} coefficients per channel)\n", probe.sh.bands, probe.sh.coefficients.size());
    text += fmt::format("mean radiance: {:.6g} {:.6g} {:.6g}\n", mean.x, mean.y, mean.z);
    text += fmt::format("illuminant: {}\n", probe.illuminant.name);
    text += window.damping > 0 ? fmt::format("ambient window: exponential, damping {:.4g}\n", window.damping)
                               : fmt::format("ambient window: {}\n", math::window_name(window.window));
    text += describe_key_lights(probe);
    text += fmt::format("light texels: {0} x {0} x 6, {1} bytes\n", probe.light.face_size, probe.light.bytes());
    text += fmt::format("environment: {} x {} x 6, {} levels, half floats times {:g}\n", layout.face_size,
                        layout.face_size, layout.levels, probe.environment.scale);
    if (probe.dome)
        text += fmt::format("dome: camera {:g} m above the floor, radius {:g} m\n", probe.dome->height_m,
                            probe.dome->radius_m);
    text += fmt::format("texels taken as black: {} (NaN {}, infinite {}, negative {})\n", probe.report.total(),
                        probe.report.nan, probe.report.infinite, probe.report.negative);
    return text;
}

}  // namespace rowland::lighting
