// Foil cards as they are drawn: a pixel is the mean of what it covers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/session.h"
#include "engine/core/file.h"
#include "engine/gpu/framebuffer.h"
#include "engine/image/byte_image.h"
#include "engine/platform/gl_context.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/foil/card.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/groove_map.h"
#include "tests/demo/demo_session.h"
#include "tests/support/files.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland {
namespace {

using diffraction::foil::NamedPictures;

/// A square of a foil on bare metal, under a lacquer, 0.2 mm for each texel. `pictures`: those that the foil names.
std::vector<std::byte> square_card(const nlohmann::json& foil, int texels, NamedPictures pictures = {}) {
    const nlohmann::json recipe = {
        {"artwork", "clear.png"},
        {"foil", foil},
        {"card", {{"width_mm", 0.2 * texels}, {"height_mm", 0.2 * texels}, {"corner_mm", 0}}},
        {"ink", "covers"},
        {"texture_px", texels}};
    const std::vector<std::uint8_t> clear(4UL * 16 * 16, 0);
    pictures["clear.png"] = {"clear.png", image::encode_png(16, 16, 4, clear)};
    return diffraction::foil::make_card(diffraction::foil::parse_foil_recipe(recipe, "card.json"), pictures,
                                        "card.json");
}

/// Green of the card's pixels, row by row from the top.
struct Pixels {
    int width = 0;
    int height = 0;
    std::vector<double> values{};

    double at(int row, int column) const {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
    double mean() const {
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    }
    /// Variance over the squared mean, by differences over two pixels: without what is coarser.
    double sparkle() const {
        double sum = 0.0;
        for (int row = 0; row + 2 < height; ++row)
            for (int column = 0; column + 2 < width; ++column)
                sum += std::pow(at(row, column) - at(row, column + 2), 2) +
                       std::pow(at(row, column) - at(row + 2, column), 2);
        return sum / (4.0 * (width - 2) * (height - 2) * mean() * mean());
    }
};

/// A picture of one pixel for each facet with two for each along rows and columns.
Pixels halved_pixels(const Pixels& facets) {
    Pixels result{2 * facets.width, 2 * facets.height};
    for (int row = 0; row < result.height; ++row)
        for (int column = 0; column < result.width; ++column) result.values.push_back(facets.at(row / 2, column / 2));
    return result;
}

/// Means over squares of `side` pixels, the first of which begins at a column.
Pixels box_means(const Pixels& fine, int side, int first_column = 0) {
    Pixels result{(fine.width - first_column) / side, fine.height / side};
    for (int row = 0; row < result.height; ++row)
        for (int column = 0; column < result.width; ++column) {
            double sum = 0.0;
            for (int i = 0; i < side * side; ++i)
                sum += fine.at(row * side + i / side, first_column + column * side + i % side);
            result.values.push_back(sum / (side * side));
        }
    return result;
}

/// Fraction of pixels that change by more than a tenth, of those that both pictures have.
double jumping(const Pixels& picture, const Pixels& next) {
    int jumps = 0;
    const int width = std::min(picture.width, next.width);
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < width; ++column) {
            const double a = picture.at(row, column);
            const double b = next.at(row, column);
            if (std::abs(a - b) > 0.1 * std::max(a, b)) ++jumps;
        }
    return static_cast<double>(jumps) / (width * picture.height);
}

/// The card from far away, so that all pixels see it from the same direction.
class Card {
 public:
    /// `shown`: the fraction of the card's width and height in the picture, so that its edges are not.
    Card(const demo::Options& options, double shown)
        : shown_(shown),
          session_(options, post::OcioConfig::choose(std::nullopt), {16, 16}, {16, 16}, demo::Pace::Still) {
        ecs::World& world = session_.play().world();
        for (int frame = 0; frame < 3 || diffraction::maps_are_filling(world); ++frame)
            session_.draw_from(session_.scene().camera(), 0.0F);
        world.view<render::MeshInstance, scene::WorldMatrix, diffraction::DiffractionSurface>().each(
            [&](ecs::Entity, const render::MeshInstance& instance, const scene::WorldMatrix& matrix,
                const diffraction::DiffractionSurface& surface) {
                surface_ = &surface;
                for (const glm::vec3& position : instance.mesh->positions) {
                    const glm::vec3 at(matrix.matrix * glm::vec4(position, 1.0F));
                    least_ = glm::min(least_, at);
                    greatest_ = glm::max(greatest_, at);
                }
            });
    }

    const diffraction::DiffractionSurface& surface() { return *surface_; }
    const glm::dmat3& xyz_to_working() { return session_.picture().xyz_to_working(); }

    /// A picture of `side` × `side` pixels; `shift`: of the camera, in pixels to the right.
    Pixels draw(int side, double shift = 0.0) {
        Pixels pixels{side, side};
        for (const glm::vec4& pixel : draw_colours(side, shift)) pixels.values.push_back(pixel.g);
        return pixels;
    }

    /// Linear working RGB, row by row from the top.
    std::vector<glm::vec4> draw_colours(int side, double shift = 0.0) {
        const float half_width = 0.5F * (greatest_.x - least_.x) * static_cast<float>(shown_);
        constexpr float kDistance = 1000.0F;  // in half widths
        const glm::vec3 target = 0.5F * (least_ + greatest_) + glm::vec3(2.0 * shift / side * half_width, 0.0F, 0.0F);
        const scene::Camera camera{.eye = target + glm::vec3(0.0F, 0.0F, kDistance * half_width),
                                   .target = target,
                                   .vertical_field_of_view = 2.0F * std::atan(1.0F / kDistance)};
        session_.picture().resize({side, side});
        session_.draw_from(camera, 0.0F);
        return session_.picture().linear().read_rgba_float();
    }

 private:
    double shown_;
    demo::Session session_;
    const diffraction::DiffractionSurface* surface_ = nullptr;
    glm::vec3 least_{1e9F};
    glm::vec3 greatest_{-1e9F};
};

/// Its mean is that of the smooth foil whose grooves have all directions; as many facets flash on an area of the card,
/// however far away it is: then the variance of pixels is that of means over independent facets; and pixels jump no
/// more than the means over their facets where the camera moves by half a pixel.
TEST(DrawnFoil, GlitterIsTheMeanOfItsFacetsAtAllDistances) {
    const platform::HeadlessContext context;
    const test::TemporaryFolder folder;
    demo::Options options = test::session_options();
    options.probe = options.cooked_folder / "studio.probe";
    options.scene = folder.path() / "glitter.glb";
    constexpr int kFacets = 630;  // in the picture, a texel each
    constexpr int kCard = 840;
    write_file_atomic(*options.scene, square_card({{"type", "glitter"}, {"size_um", 200}, {"seed", 2}}, kCard));
    Card card(options, static_cast<double>(kFacets) / kCard);
    const Pixels facets = card.draw(kFacets);  // one for each pixel
    ASSERT_GT(facets.sparkle(), 2.0);
    const Pixels fine = halved_pixels(facets);
    for (const int side : {5, 9, 15, 21, 35}) {  // of a pixel, in halves of a facet: edges of pixels cut facets
        const int pixels = fine.width / side;
        std::vector<Pixels> drawn;  // as the camera moves by quarters of a pixel
        std::vector<Pixels> exact;
        double drawn_sparkle = 0.0;
        double exact_sparkle = 0.0;
        for (int quarter = 0; quarter < 4; ++quarter) {
            const int shift = quarter * side / 4;
            drawn.push_back(card.draw(pixels, static_cast<double>(shift) / side));
            exact.push_back(box_means(fine, side, shift));
            drawn_sparkle += drawn.back().sparkle();
            exact_sparkle += exact.back().sparkle();
        }
        const double mean = drawn[0].mean() / exact[0].mean();
        const double density = exact_sparkle / drawn_sparkle;
        const double jumps = jumping(drawn[0], drawn[2]);
        const double content = jumping(exact[0], exact[2]);
        fmt::print("{:6.2f} facets: mean {:.3f}, density of sparks {:.3f}, jump {:.1f} % (content {:.1f} %)\n",
                   side * side / 4.0, mean, density, 100.0 * jumps, 100.0 * content);
        EXPECT_NEAR(mean, 1.0, 0.02) << side;
        EXPECT_NEAR(density, 1.0, 0.1) << side;
        EXPECT_LE(jumps, content + 0.04) << side;
    }
}

/// A square of foil, in which the grooves of each texel have a direction of their own, and no recipe.
std::vector<std::byte> random_grooves(bool sparkles) {
    constexpr int kTexels = 256;
    constexpr std::uint8_t kOwnPitch = 128;
    std::mt19937 random(7);
    std::vector<std::uint8_t> grooves;
    for (int i = 0; i < kTexels * kTexels; ++i)
        grooves.insert(grooves.end(), {static_cast<std::uint8_t>(random() % 256), kOwnPitch, 0});
    const std::vector<std::byte> picture = image::encode_png(kTexels, kTexels, 3, grooves);
    nlohmann::json file = {{"asset", {{"version", "2.0"}}},
                           {"extensionsUsed", {diffraction::kGltfExtension}},
                           {"scenes", {{{"nodes", {0}}}}},
                           {"nodes", {{{"mesh", 0}, {"rotation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}}}},
                           {"textures", {{{"source", 0}}}},
                           {"images", {{{"uri", scene::test::data_uri(picture, "image/png")}}}}};
    file["materials"][0]["extensions"][diffraction::kGltfExtension] = {
        {"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}},
        {"grooveTexture", {{"index", 0}, {"sparkle", sparkles}}},
        {"quality", {{"representation", "direct"}}}};
    nlohmann::json square =
        scene::test::primitive_of(file, scene::build_mesh(scene::PlaneRecipe{.width = 1.0, .depth = 1.0}));
    square["material"] = 0;
    file["meshes"] = {{{"primitives", {square}}}};
    return scene::test::glb_of(file);
}

/// Pixels are as smooth as the means of their moments, unless the texture says that its facets sparkle.
TEST(DrawnFoil, SparklesWhereItsTextureSaysSo) {
    const platform::HeadlessContext context;
    const test::TemporaryFolder folder;
    const auto drawn = [&](bool sparkles) {
        demo::Options options = test::session_options();
        options.probe = options.cooked_folder / "studio.probe";
        options.scene = folder.path() / (sparkles ? "sparkling.glb" : "smooth.glb");
        write_file_atomic(*options.scene, random_grooves(sparkles));
        return Card(options, 0.75).draw(16);  // 144 texels in each pixel: a part of it has several
    };
    const Pixels smooth = drawn(false);
    const Pixels sparkling = drawn(true);
    EXPECT_GT(sparkling.sparkle(), 4.0 * smooth.sparkle());
    EXPECT_NEAR(sparkling.mean() / smooth.mean(), 1.0, 0.15);
}

constexpr int kKinegram = 512;
constexpr int kShown = 384;

/// A picture as bright as `brightness` says of the column and row, both in [0, 1), as PNG.
template <typename Brightness>
std::vector<std::byte> picture_of(const Brightness& brightness) {
    constexpr int kSide = 64;
    std::vector<std::uint8_t> rgb;
    for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column)
            rgb.insert(rgb.end(), 3,
                       static_cast<std::uint8_t>(255.0 * brightness((column + 0.5) / kSide, (row + 0.5) / kSide)));
    return image::encode_png(kSide, kSide, 3, rgb);
}

/// The pixels of a kinegram are the means over its texels' grooves by the reference; but for what all grooves have in
/// common, order 0 and the lacquer's gloss, which is fitted.
TEST(DrawnFoil, KinegramIsTheMeanOfTheReferenceOverItsCells) {
    const platform::HeadlessContext context;
    const test::TemporaryFolder folder;
    demo::Options options = test::session_options();
    options.scene = folder.path() / "kinegram.glb";
    const nlohmann::json foil_json = {
        {"type", "two_pictures"}, {"picture_a", "a.png"}, {"picture_b", "b.png"}, {"cell_mm", 0.2}};
    const NamedPictures pictures = {{"a.png", {"a.png", picture_of([](double x, double) { return x; })}},
                                    {"b.png", {"b.png", picture_of([](double, double y) { return y; })}}};
    write_file_atomic(*options.scene, square_card(foil_json, kKinegram, pictures));

    for (const char* probe : {"night", "captured_studio"}) {
        options.probe = options.cooked_folder / (std::string(probe) + ".probe");
        if (!std::filesystem::exists(*options.probe)) continue;
        Card card(options, static_cast<double>(kShown) / kKinegram);
        const diffraction::DiffractionSurface& surface = card.surface();
        const diffraction::Material& material = surface.material->cooked()->material;
        const demo::FullResolutionProbe light =
            demo::load_full_resolution_probe(*options.probe, "auto", options.content_folder / "probes");
        const glm::dmat3 xyz_to_working = card.xyz_to_working();
        std::map<std::pair<double, double>, glm::dvec3> colours;  // of grooves by their red and green
        const auto colour_of = [&](double rotation, double half_pitch) {
            const auto [found, is_new] = colours.try_emplace({rotation, half_pitch});
            if (is_new) {
                diffraction::Grating grating = material.grating;
                grating.pitch_nm *= 2.0 * half_pitch;
                const double angle = std::numbers::pi * rotation;
                const diffraction::ShadingPoint point{.view = {0.0, 0.0, 1.0},
                                                      .normal = {0.0, 0.0, 1.0},
                                                      .grating = {std::cos(angle), std::sin(angle), 0.0}};
                found->second =
                    xyz_to_working * diffraction::reference_radiance(grating, light.image,
                                                                     colour::LightSpectra(material.quality.illuminant),
                                                                     std::span(&point, 1))[0];
            }
            return found->second;
        };
        const image::ByteImage& grooves = *surface.grooves->image();
        constexpr int kSide = 8;  // of a pixel, in texels
        const std::vector<glm::vec4> drawn = card.draw_colours(kShown / kSide);
        std::vector<glm::dvec3> expected;
        glm::dvec3 common(0.0);
        for (int i = 0; i < static_cast<int>(drawn.size()); ++i) {
            glm::dvec3 sum(0.0);
            for (int j = 0; j < kSide * kSide; ++j) {
                const int x = (kKinegram - kShown) / 2 + i % (kShown / kSide) * kSide + j % kSide;
                const int y = (kKinegram - kShown) / 2 + i / (kShown / kSide) * kSide + j / kSide;
                const auto texel = 4 * (static_cast<std::size_t>(y) * kKinegram + static_cast<std::size_t>(x));
                sum += colour_of(grooves.value(texel), grooves.value(texel + 1));
            }
            expected.push_back(sum / static_cast<double>(kSide * kSide));
            common +=
                (glm::dvec3(drawn[static_cast<std::size_t>(i)]) - expected.back()) / static_cast<double>(drawn.size());
        }
        double off = 0.0;
        double whole = 0.0;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            const glm::dvec3 difference = glm::dvec3(drawn[i]) - common - expected[i];
            off += glm::dot(difference, difference);
            whole += glm::dot(expected[i], expected[i]);
        }
        const double error = std::sqrt(off / whole);
        fmt::print("{}: {:.2f} % off the reference\n", probe, 100.0 * error);
        EXPECT_EQ(colours.size(), 3U);
        EXPECT_LE(error, 0.05) << probe;
    }
}

}  // namespace
}  // namespace rowland
