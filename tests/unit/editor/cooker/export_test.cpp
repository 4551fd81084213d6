// What `rowland-cook export` writes, read back and shaded by a few obvious lines.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

#include "engine/core/file.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "tests/support/files.h"
#include "tests/support/json_schema.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;

constexpr std::size_t kPoints = 100;
const std::filesystem::path kCd = test::content_path("materials/cd_paper.json");

/// An exported document.
class Export {
 public:
    Export(const std::filesystem::path& material, const test::Command& more) {
        const std::filesystem::path file = folder_.path() / "out.json";
        test::Command command{ROWLAND_COOK, "export", material.string(), "-o", file.string()};
        command.insert(command.end(), more.begin(), more.end());
        const test::Ended ended = test::run(command);
        EXPECT_EQ(ended.code, 0) << ended.err;
        text = read_text_file(file, 1 << 20);
        bytes = read_file(folder_.path() / "out.bin", 1 << 24);
        json = nlohmann::json::parse(text);
    }

    std::vector<float> array(const char* pointer) const {
        const nlohmann::json& place = json.at(nlohmann::json::json_pointer(pointer));
        std::size_t count = 1;
        for (const std::size_t length : place["shape"]) count *= length;
        std::vector<float> values(count);
        EXPECT_LE(place["offset"].get<std::size_t>() + 4 * count, bytes.size());
        std::memcpy(values.data(), bytes.data() + place["offset"].get<std::size_t>(), 4 * count);
        return values;
    }
    std::size_t length(const char* pointer, std::size_t axis) const {
        return json.at(nlohmann::json::json_pointer(pointer))["shape"][axis];
    }
    glm::dvec3 vector(const char* pointer) const {
        const nlohmann::json& numbers = json.at(nlohmann::json::json_pointer(pointer));
        return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
    }

    std::string text;
    std::vector<std::byte> bytes;
    nlohmann::json json;

 private:
    test::TemporaryFolder folder_;
};

std::vector<diffraction::ShadingPoint> points(const glm::dvec3* fixed_normal) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto direction = [&] { return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))); };
    std::vector<diffraction::ShadingPoint> result;
    while (result.size() < kPoints) {
        const glm::dvec3 n = fixed_normal != nullptr ? *fixed_normal : direction();
        const glm::dvec3 v = direction();
        const glm::dvec3 across = direction();
        const glm::dvec3 g = glm::normalize(across - glm::dot(across, n) * n);
        result.push_back({.view = glm::dot(v, n) < 0.0 ? -v : v, .normal = n, .grating = g});
    }
    return result;
}

std::vector<glm::dvec3> evaluated(const std::filesystem::path& probe, const std::string& method, int key_lights,
                                  std::span<const diffraction::ShadingPoint> frames,
                                  const std::filesystem::path& file = kCd) {
    const nlohmann::json source = diffraction::load_material_json(file);
    const diffraction::Material material = diffraction::with_efficiencies(
        diffraction::parse_material(with_method(source, diffraction::parse_method(method)), file.string()),
        file.string());
    const diffraction::EvaluationLight light(lighting::load_probe_image(probe, lighting::Mapping::Equirectangular),
                                             key_lights, math::SphericalWindow::None);
    return evaluate_baked(bake_material(material), light, frames);
}

/// Largest difference over the largest component.
double difference(std::span<const glm::dvec3> found, std::span<const glm::dvec3> expected) {
    double worst = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(found[i][c] - expected[i][c]));
            largest = std::max(largest, std::abs(expected[i][c]));
        }
    EXPECT_GT(largest, 0.0);
    return worst / largest;
}

/// FORMAT.md, "Planar".
glm::dvec3 from_map(const Export& document, const std::vector<float>& xyz, const diffraction::ShadingPoint& point) {
    const auto views = static_cast<int>(document.length("/planar/xyz", 0));
    const auto azimuths = static_cast<int>(document.length("/planar/xyz", 1));
    const double phi = std::atan2(glm::dot(point.grating, document.vector("/planar/e2")),
                                  glm::dot(point.grating, document.vector("/planar/e1")));
    const double column = (phi < 0.0 ? phi + 2.0 * pi : phi) / (2.0 * pi) * azimuths;
    const double row = 0.5 * (glm::dot(point.view, point.grating) + 1.0) * (views - 1);
    const int i = static_cast<int>(column);
    const int j = std::min(static_cast<int>(row), views - 2);
    const auto texel = [&](int x, int y) {
        const float* at = &xyz[3 * static_cast<std::size_t>(y * azimuths + x % azimuths)];
        return glm::dvec3(at[0], at[1], at[2]);
    };
    return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), column - i),
                    glm::mix(texel(i, j + 1), texel(i + 1, j + 1), column - i), row - j);
}

TEST(Export, AMapShadesAsThePlanarRepresentationDoes) {
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    const Export document(
        kCd, {"--probe", probe.string(), "--key-lights", "0", "--planar", "1", "2", "-1", "--resolution", "64"});
    const glm::dvec3 normal = document.vector("/planar/normal");
    EXPECT_NEAR(glm::dot(normal, glm::normalize(glm::dvec3(1.0, 2.0, -1.0))), 1.0, 1e-12);
    const auto frames = points(&normal);
    const std::vector<float> xyz = document.array("/planar/xyz");
    std::vector<glm::dvec3> found;
    for (const auto& point : frames) found.push_back(from_map(document, xyz, point));
    EXPECT_LT(difference(found, evaluated(probe, "planar/map_resolution=64", 0, frames)), 1e-5);
}

/// SH of the light in the frame (g, h, n), by sums over the sphere: exact for few bands but for the rounding.
std::vector<glm::dvec3> in_frame(const std::vector<float>& sh, int bands, const glm::dmat3& to_world) {
    const auto count = static_cast<std::size_t>(math::sh_count(bands));
    std::vector<glm::dvec3> result(count, glm::dvec3(0.0));
    std::vector<double> here(count);
    std::vector<double> there(count);
    constexpr int kRows = 200;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < 32; ++column) {
            const double z = -1.0 + (2.0 * row + 1.0) / kRows;
            const double phi = 2.0 * pi * column / 32;
            const glm::dvec3 s(std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z);
            math::evaluate_sh(s, bands, here);
            math::evaluate_sh(to_world * s, bands, there);
            glm::dvec3 radiance(0.0);
            for (std::size_t i = 0; i < count; ++i)
                radiance += there[i] * glm::dvec3(sh[3 * i], sh[3 * i + 1], sh[3 * i + 2]);
            for (std::size_t i = 0; i < count; ++i) result[i] += 4.0 * pi / (kRows * 32) * here[i] * radiance;
        }
    return result;
}

/// FORMAT.md, "Arc", of one-dimensional views.
glm::dvec3 from_arc(const Export& document, const diffraction::ShadingPoint& point) {
    const std::vector<float> weights = document.array("/arc/weights");
    const std::vector<float> factors = document.array("/arc/factors");
    const std::vector<float> moments = document.array("/arc/moments");
    const std::size_t columns = document.length("/arc/weights", 1);
    const std::size_t rank = document.length("/arc/weights", 2);
    const std::size_t terms = document.length("/arc/moments", 0);
    const glm::dmat3 to_world(point.grating, glm::cross(point.normal, point.grating), point.normal);
    const std::vector<glm::dvec3> sh =
        in_frame(document.array("/probe/rest_sh"), document.json["arc"]["bands"], to_world);
    std::vector<glm::dvec3> q(terms, glm::dvec3(0.0));
    for (std::size_t k = 0; k < terms; ++k)
        for (std::size_t i = 0; i < sh.size(); ++i) q[k] += double{moments[k * sh.size() + i]} * sh[i];
    const double position = 0.5 * (glm::dot(point.view, point.grating) + 1.0) * static_cast<double>(columns - 1);
    const std::size_t column = std::min(static_cast<std::size_t>(position), columns - 2);
    glm::dvec3 xyz(0.0);
    for (std::size_t r = 0; r < rank; ++r) {
        const double w = std::lerp(double{weights[column * rank + r]}, double{weights[(column + 1) * rank + r]},
                                   position - static_cast<double>(column));
        for (std::size_t k = 0; k < terms; ++k)
            for (std::size_t o = 0; o < 3; ++o)
                for (std::size_t c = 0; c < 3; ++c)
                    xyz[static_cast<int>(o)] +=
                        w * double{factors[((r * terms + k) * 3 + o) * 3 + c]} * q[k][static_cast<int>(c)];
    }
    return xyz;
}

TEST(Export, AnArcTableShadesAsTheArcRepresentationDoes) {
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    const Export document(kCd, {"--probe", probe.string(), "--key-lights", "0", "--arc"});
    auto frames = points(nullptr);
    frames.resize(20);
    std::vector<glm::dvec3> found;
    for (const auto& point : frames) found.push_back(from_arc(document, point));
    EXPECT_LT(difference(found, evaluated(probe, "arc/bands=5/rank=8/storage=fp32", 0, frames)), 1e-3);
}

/// An ascending array's two entries around a value, and the weight of the second: constant beyond the ends.
struct Between {
    std::size_t first = 0;
    double weight = 0.0;
};
Between between(const std::vector<double>& nodes, double value) {
    std::size_t i = 0;
    while (i + 2 < nodes.size() && nodes[i + 1] < value) ++i;
    return {i, std::clamp((value - nodes[i]) / (nodes[i + 1] - nodes[i]), 0.0, 1.0)};
}

/// FORMAT.md, "Kernel": the antiderivative as one view sees it, nine numbers an entry.
std::vector<double> kernel_seen(const Export& document, double v_g) {
    const std::vector<float> kernel = document.array("/material/kernel/antiderivative");
    const nlohmann::json& json = document.json["material"]["kernel"];
    if (!json.contains("views")) return {kernel.begin(), kernel.end()};
    const std::size_t size = kernel.size() / json["views"].size();
    const auto [view, weight] = between(json["views"], v_g);
    std::vector<double> seen;
    for (std::size_t i = 0; i < size; ++i)
        seen.push_back(std::lerp(double{kernel[view * size + i]}, double{kernel[(view + 1) * size + i]}, weight));
    return seen;
}

/// Of a von Mises-Fisher lobe of flux 1, by sums over the part of the sphere where it is.
glm::dvec3 from_lobe(const Export& document, const std::vector<double>& kernel, const nlohmann::json& light,
                     const diffraction::ShadingPoint& point) {
    const double pitch_nm = document.json["material"]["pitch_nm"];
    const double begin_nm = document.json["material"]["kernel"]["begin_nm"];
    const double end_nm = document.json["material"]["kernel"]["end_nm"];
    const std::size_t nodes = kernel.size() / 9;
    const double last = static_cast<double>(nodes) - 1.0;
    const auto antiderivative = [&](double x_nm, int o, int c) {
        const double position = std::clamp((x_nm - begin_nm) / (end_nm - begin_nm), 0.0, 1.0) * last;
        const std::size_t i = std::min(static_cast<std::size_t>(position), kernel.size() / 9 - 2);
        const std::size_t entry = static_cast<std::size_t>(3 * o + c);
        return std::lerp(kernel[9 * i + entry], kernel[9 * (i + 1) + entry], position - static_cast<double>(i));
    };
    const auto vector = [](const nlohmann::json& x) {
        return glm::dvec3(x[0].get<double>(), x[1].get<double>(), x[2].get<double>());
    };
    const glm::dvec3 axis = vector(light["direction"]);
    const glm::dvec3 flux = vector(light["flux"]);
    const double concentration = light["concentration"];
    const glm::dvec3 aside =
        glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    glm::dvec3 xyz(0.0);
    constexpr int kRings = 48;
    constexpr int kTurns = 48;
    for (int ring = 0; ring < kRings; ++ring)
        for (int turn = 0; turn < kTurns; ++turn) {
            // Directions of equal power: 1 - cosine is exponentially distributed.
            const double depth =
                -std::log(1.0 - (ring + 0.5) / kRings * -std::expm1(-2.0 * concentration)) / concentration;
            const double sine = std::sqrt(depth * (2.0 - depth));
            const double phi = 2.0 * pi * (turn + 0.5 * (ring % 2)) / kTurns;
            const glm::dvec3 s =
                (1.0 - depth) * axis + sine * (std::cos(phi) * aside + std::sin(phi) * glm::cross(axis, aside));
            const double u = glm::dot(s + point.view, point.grating);
            const double half = 0.5 / std::sqrt(concentration) / 8.0;  // between neighbouring directions
            const double above = std::max(glm::dot(s, point.normal), 0.0);
            for (int o = 0; o < 3; ++o)
                for (int c = 0; c < 3; ++c)
                    xyz[o] +=
                        0.5 * above * flux[c] / (kRings * kTurns) *
                        (antiderivative(pitch_nm * (u + half), o, c) - antiderivative(pitch_nm * (u - half), o, c)) /
                        (2.0 * half);
        }
    return xyz;
}

/// The probe's key lights. `seen_from`: the v_g whose kernel is taken, or that of each point.
std::vector<glm::dvec3> from_key_lights(const Export& document, std::span<const diffraction::ShadingPoint> frames,
                                        std::optional<double> seen_from = std::nullopt) {
    std::vector<glm::dvec3> found;
    for (const auto& point : frames) {
        const std::vector<double> kernel =
            kernel_seen(document, seen_from.value_or(glm::dot(point.view, point.grating)));
        found.emplace_back(0.0);
        for (const nlohmann::json& light : document.json["probe"]["key_lights"])
            found.back() += from_lobe(document, kernel, light, point);
    }
    return found;
}

// Key lights as `direct` shades them are approximations of lobes (MEASUREMENTS §11): 2 % for the widest there are, as
// these four.
constexpr double kLobeTolerance = 2.5e-2;

TEST(Export, KeyLightsAndTheKernelShadeAsTheDirectRepresentationDoes) {
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    const Export document(kCd, {"--probe", probe.string(), "--key-lights", "4"});
    auto frames = points(nullptr);
    frames.resize(12);
    EXPECT_EQ(document.json["probe"]["key_lights"].size(), 4U);
    EXPECT_LT(difference(from_key_lights(document, frames), evaluated(probe, "direct", 4, frames)), kLobeTolerance);
}

/// Materials whose efficiencies depend on the direction.
class ViewDependentExport : public testing::Test {
 protected:
    std::filesystem::path write(const char* name, const std::string& text) {
        write_file_atomic(folder_.path() / name, std::string_view(text));
        return folder_.path() / name;
    }
    std::filesystem::path rigorous() {
        return write("rigorous.json", R"({"grating": {"pitch_nm": 700, "theory": "rigorous", "orders": [-1, 1],
            "profile": {"type": "sinusoidal", "depth_nm": 120}}, "metal": "Al"})");
    }
    /// Whose opposite orders are not equally bright.
    std::filesystem::path table() {
        std::string rows = "wavelength_nm,incidence_deg,R-1,R+0,R+1\n";
        for (const int incidence : {-80, 0, 80})
            for (const int wavelength : {380, 780})
                rows += fmt::format("{},{},{},0.1,{}\n", wavelength, incidence, 0.15 - 0.001 * incidence,
                                    0.25 + 0.002 * incidence);
        write("table.csv", rows);
        return write("table.json", R"({"grating": {"pitch_nm": 700, "orders": [-1, 1],
            "profile": {"type": "table", "file": "table.csv"}}})");
    }

 private:
    test::TemporaryFolder folder_;
};

TEST_F(ViewDependentExport, EachPartShadesAsItsRepresentationDoes) {
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    for (const std::filesystem::path& file : {rigorous(), table()}) {
        const Export maps(file, {"--probe", probe.string(), "--key-lights", "0", "--arc", "--planar", "1", "2", "-1",
                                 "--resolution", "64"});
        const glm::dvec3 normal = maps.vector("/planar/normal");
        const auto flat = points(&normal);
        const std::vector<float> xyz = maps.array("/planar/xyz");
        std::vector<glm::dvec3> found;
        for (const auto& point : flat) found.push_back(from_map(maps, xyz, point));
        EXPECT_LT(difference(found, evaluated(probe, "planar/map_resolution=64", 0, flat, file)), 1e-5) << file;

        auto frames = points(nullptr);
        frames.resize(12);
        found.clear();
        for (const auto& point : frames) found.push_back(from_arc(maps, point));
        EXPECT_LT(difference(found, evaluated(probe, "arc/bands=5/rank=8/storage=fp32", 0, frames, file)), 1e-3);

        const Export lights(file, {"--probe", probe.string(), "--key-lights", "4"});
        const std::vector<glm::dvec3> expected = evaluated(probe, "direct", 4, frames, file);
        EXPECT_LT(difference(from_key_lights(lights, frames), expected), kLobeTolerance) << file;
        EXPECT_GT(difference(from_key_lights(lights, frames, 0.0), expected), 2.0 * kLobeTolerance) << file;
    }
}

TEST_F(ViewDependentExport, HoldsTheEfficienciesAndWhetherOppositeViewsAreAlike) {
    const nlohmann::json schema = nlohmann::json::parse(
        read_text_file(test::source_path("modules/diffraction/portable/portable.schema.json"), 1 << 20));
    for (const std::filesystem::path& file : {rigorous(), table()}) {
        const Export document(file, {});
        EXPECT_EQ(document.json["version"], 2);
        EXPECT_TRUE(test::satisfies(document.json, schema));
        for (const char* without : {"/material/efficiencies", "/material/kernel/views", "/material/smoothing/views"}) {
            const nlohmann::json patch = {{{"op", "remove"}, {"path", without}}};
            EXPECT_FALSE(test::satisfies(document.json.patch(patch), schema)) << without;
        }
        const diffraction::Material material =
            diffraction::with_efficiencies(diffraction::load_material(file), file.string());
        const nlohmann::json& json = document.json["material"]["efficiencies"];
        const std::vector<float> values = document.array("/material/efficiencies/values");
        std::size_t i = 0;
        for (const int order : json["orders"])
            for (std::size_t row = 0; row < document.length("/material/efficiencies/values", 1); ++row)
                for (const double v_g : json["views"])
                    EXPECT_NEAR(values[i++],
                                order_efficiency(material.grating, order,
                                                 json["begin_nm"].get<double>() +
                                                     static_cast<double>(row) * json["step_nm"].get<double>(),
                                                 v_g),
                                1e-6);
        EXPECT_EQ(i, values.size());
        EXPECT_EQ(document.json["material"]["kernel"]["even"], file.stem() == "rigorous");
    }
}

/// The sRGB standard's matrix (IEC 61966-2-1), row by row: its four digits.
TEST(Export, ItsColoursAreThoseOfTheStandard) {
    const std::vector<double> published = {3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570};
    const nlohmann::json json = Export(kCd, {}).json;
    ASSERT_EQ(json["xyz_to_linear_srgb"].size(), published.size());
    for (std::size_t i = 0; i < published.size(); ++i)
        EXPECT_NEAR(json["xyz_to_linear_srgb"][i].get<double>(), published[i], 5e-4) << i;
}

TEST(Export, IsSmallSatisfiesItsSchemaAndHasTheSameBytesEveryTime) {
    const Export document(test::content_path("materials/cd.json"), {});
    EXPECT_EQ(document.json["version"], 1);
    EXPECT_EQ(document.bytes.size(), 4U * 9 * 2048);
    EXPECT_LT(document.text.size(), 4000U);
    const nlohmann::json schema = nlohmann::json::parse(
        read_text_file(test::source_path("modules/diffraction/portable/portable.schema.json"), 1 << 20));
    EXPECT_TRUE(test::satisfies(document.json, schema));
    nlohmann::json without = document.json;
    without["material"].erase("kernel");
    EXPECT_FALSE(test::satisfies(without, schema));
    const Export again(test::content_path("materials/cd.json"), {});
    EXPECT_EQ(document.text, again.text);
    EXPECT_TRUE(document.bytes == again.bytes);
}

TEST(Export, RefusesWhatItCannotWriteOrMap) {
    const test::TemporaryFolder folder;
    const auto message = [&](const test::Command& more) {
        test::Command command{ROWLAND_COOK, "export", kCd.string()};
        command.insert(command.end(), more.begin(), more.end());
        const test::Ended ended = test::run(command, {.folder = folder.path()});
        EXPECT_EQ(ended.code, 2) << ended.err;
        return ended.err;
    };
    EXPECT_THAT(message({"-o", "out.txt"}), HasSubstr(".json"));
    EXPECT_THAT(message({"-o", "out.json", "--planar", "0", "1", "0"}), HasSubstr("no --probe"));
    EXPECT_THAT(message({"-o", "out.json", "--resolution", "33"}), HasSubstr("33 is odd"));
    EXPECT_THAT(message({"-o", "out.json", "--planar", "1e300", "0", "0"}), HasSubstr("no number"));
    for (const char* material : {"materials/diffraction_glasses.json", "materials/screen_door.json"}) {
        const test::Ended ended =
            test::run({ROWLAND_COOK, "export", test::content_path(material).string(), "-o", "out.json"},
                      {.folder = folder.path()});
        EXPECT_EQ(ended.code, 2) << material;
        EXPECT_THAT(ended.err, HasSubstr("document")) << material;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace rowland
