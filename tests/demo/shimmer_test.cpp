// Pixels average what they cover: pictures equal supersampled ones, and hold still while the camera moves by less than
// a pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "content/demo/pixel/surface_point.h"
#include "content/demo/play/body.h"
#include "content/demo/session.h"
#include "engine/core/file.h"
#include "engine/gpu/framebuffer.h"
#include "engine/platform/gl_context.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/demo/demo_session.h"
#include "tests/support/files.h"

namespace rowland {
namespace {

/// How well pixels average what they cover of one object, in one view under one probe.
struct PixelAverage {
    std::size_t pixels = 0;  ///< of the object, without those at its edges
    /// Fraction of them that change by more than a tenth when the camera moves by half a pixel around the object.
    double jumping = 0.0;
    double change = 0.0;  ///< by that step: relative RMS, components cut off at 1
    /// `jumping` of pictures of 16 samples per pixel: what the content itself does. Measured where `jumping` is not
    /// small.
    double content_jumping = 0.0;
    /// Relative RMS of the linear picture against one of 16 samples per pixel, each shaded for its own footprint: what
    /// shading per pixel costs, and within an object its outline against itself. Not in it: the object's edges, the
    /// four samples that resolve them, and what both pictures share (probe, maps, shadows, half floats).
    double error = 0.0;
    double displayed = 0.0;  ///< the same with components cut off at 1, diffuse white
};

/// Measures the gratings of the demo's scene.
class Shimmer {
 public:
    Shimmer(const demo::Options& options, glm::ivec2 size);

    /// Fraction of pixels whose jumping is small.
    static constexpr double kCalm = 0.04;

    /// By the objects' names. `with_error`: draws pictures of 16 samples as well.
    std::map<std::string, PixelAverage> measure(const scene::Camera& camera, bool with_error);

    demo::Session& session() { return session_; }

 private:
    using Pixels = std::vector<glm::vec4>;
    /// An object in the picture.
    struct Seen {
        std::vector<std::size_t> pixels;  ///< without those at its edges
        glm::vec3 sum{0.0F};              ///< of their points in the world
    };

    /// Draws at least so many frames, and until maps are full.
    Pixels draw(const scene::Camera& camera, int frames);
    Pixels draw_supersampled(const scene::Camera& camera);
    std::map<std::string, Seen> see(const scene::Camera& camera);

    glm::ivec2 size_;
    demo::Session session_;
};

constexpr double kJump = 0.1;
constexpr int kSide = 4;  ///< samples along a pixel's side
constexpr double kWhite = 1.0;
constexpr double kNoWhite = std::numeric_limits<double>::infinity();

/// The camera half a pixel aside, so turned that a point stays where it is in the picture.
scene::Camera moved(const scene::Camera& camera, int rows, const glm::vec3& point) {
    const float pixel = 2.0F * std::tan(0.5F * camera.vertical_field_of_view) / static_cast<float>(rows);
    const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
    const float distance = glm::dot(point - camera.eye, ahead);
    const glm::vec3 step = 0.5F * pixel * distance * glm::vec3(glm::row(camera.view(), 0));
    scene::Camera result = camera;
    result.eye += step;
    result.target += step * (1.0F - glm::distance(camera.target, camera.eye) / distance);
    return result;
}

double relative_rms(const std::vector<std::size_t>& at, const std::vector<glm::vec4>& picture,
                    const std::vector<glm::vec4>& reference, double white) {
    double difference = 0.0;
    double whole = 0.0;
    for (const std::size_t i : at) {
        const glm::dvec3 wanted = glm::min(glm::dvec3(reference[i]), white);
        const glm::dvec3 off = glm::min(glm::dvec3(picture[i]), white) - wanted;
        difference += glm::dot(off, off);
        whole += glm::dot(wanted, wanted);
    }
    return std::sqrt(difference / whole);
}

double fraction_jumping(const std::vector<std::size_t>& at, const std::vector<glm::vec4>& picture,
                        const std::vector<glm::vec4>& next) {
    const auto jumps = [&](std::size_t i) {
        const glm::vec3 a(picture[i]);
        const glm::vec3 b(next[i]);
        return glm::length(a - b) > kJump * std::max(glm::length(a), glm::length(b));
    };
    return static_cast<double>(std::ranges::count_if(at, jumps)) / static_cast<double>(at.size());
}

Shimmer::Shimmer(const demo::Options& options, glm::ivec2 size)
    : size_(size), session_(options, post::OcioConfig::choose(std::nullopt), size, size, demo::Pace::Still) {}

Shimmer::Pixels Shimmer::draw(const scene::Camera& camera, int frames) {
    for (int frame = 0; frame < frames || diffraction::maps_are_filling(session_.play().world()); ++frame)
        session_.draw_from(camera, 0.0F);
    return session_.picture().linear().read_rgba_float();
}

Shimmer::Pixels Shimmer::draw_supersampled(const scene::Camera& camera) {
    const glm::ivec2 fine = kSide * size_;
    const gpu::Framebuffer target({.width = fine.x, .height = fine.y, .depth = true});
    session_.picture().renderer().render(session_.play().world(), camera, target);
    const Pixels samples = target.read_rgba_float();
    Pixels mean(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y), glm::vec4(0.0F));
    for (int row = 0; row < fine.y; ++row)
        for (int column = 0; column < fine.x; ++column)
            mean[static_cast<std::size_t>(row / kSide) * static_cast<std::size_t>(size_.x) +
                 static_cast<std::size_t>(column / kSide)] +=
                samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(fine.x) +
                        static_cast<std::size_t>(column)] /
                static_cast<float>(kSide * kSide);
    return mean;
}

std::map<std::string, Shimmer::Seen> Shimmer::see(const scene::Camera& camera) {
    ecs::World& world = session_.play().world();
    std::vector<demo::PlacedMesh> meshes;
    std::vector<std::string> gratings;  // of each mesh; empty if it has none
    world.view<render::MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const render::MeshInstance& instance, const scene::WorldMatrix& matrix) {
            meshes.push_back({instance.mesh, matrix.matrix});
            const bool grating = world.find<diffraction::DiffractionSurface>(entity) != nullptr;
            gratings.push_back(grating ? demo::name_of_object(world, entity) : "");
        });
    const auto points = demo::visible_points(camera, size_, meshes);
    const auto at = [&](int row, int column) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(column);
    };
    std::map<std::string, Seen> result;
    for (int row = 1; row + 1 < size_.y; ++row)
        for (int column = 1; column + 1 < size_.x; ++column) {
            const auto& here = points[at(row, column)];
            if (!here || gratings[here->mesh].empty()) continue;
            bool inner = true;
            for (int i = 0; i < 9; ++i) {
                const auto& beside = points[at(row + i / 3 - 1, column + i % 3 - 1)];
                inner = inner && beside && beside->mesh == here->mesh;
            }
            if (!inner) continue;
            Seen& seen = result[gratings[here->mesh]];
            seen.pixels.push_back(at(row, column));
            seen.sum += here->point;
        }
    return result;
}

std::map<std::string, PixelAverage> Shimmer::measure(const scene::Camera& camera, bool with_error) {
    const Pixels picture = draw(camera, 2);  // a map is full in the second frame at rest
    const Pixels reference = with_error ? draw_supersampled(camera) : picture;
    std::map<std::string, PixelAverage> result;
    for (const auto& [object, seen] : see(camera)) {
        const glm::vec3 middle = seen.sum / static_cast<float>(seen.pixels.size());
        const scene::Camera aside = moved(camera, size_.y, middle);
        const Pixels next = draw(aside, 1);  // maps do not depend on the camera
        const double jumping = fraction_jumping(seen.pixels, picture, next);
        double content_jumping = 0.0;
        if (with_error && jumping > kCalm)
            content_jumping = fraction_jumping(seen.pixels, reference, draw_supersampled(aside));
        result[object] = {.pixels = seen.pixels.size(),
                          .jumping = jumping,
                          .change = relative_rms(seen.pixels, next, picture, kWhite),
                          .content_jumping = content_jumping,
                          .error = relative_rms(seen.pixels, picture, reference, kNoWhite),
                          .displayed = relative_rms(seen.pixels, picture, reference, kWhite)};
    }
    return result;
}

constexpr glm::ivec2 kSize{1280, 720};
constexpr const char* kFoil = "foil card";

demo::Options cabinet() {
    demo::Options options = test::cabinet_options();
    options.probe = options.cooked_folder / "studio.probe";
    return options;
}

/// The scene with another text of the same JSON in place of one. A GLB file begins with its length at byte 8 and the
/// length of its JSON at byte 12; the JSON begins at byte 20, and spaces fill its last word.
std::string with_json(std::string glb, const std::string& old_text, const std::string& new_text) {
    const auto length_at = [&](std::size_t at) -> std::uint32_t {
        std::uint32_t length = 0;
        std::memcpy(&length, glb.data() + at, sizeof length);
        return length;
    };
    const std::uint32_t old_length = length_at(12);
    std::string json = glb.substr(20, old_length);
    const std::size_t found = json.find(old_text);
    EXPECT_NE(found, std::string::npos) << old_text;
    if (found == std::string::npos) return glb;
    json.replace(found, old_text.size(), new_text);
    json.append((4 - json.size() % 4) % 4, ' ');
    const auto new_length = static_cast<std::uint32_t>(json.size());
    const std::uint32_t whole = length_at(8) + new_length - old_length;
    glb.replace(20, old_length, json);
    std::memcpy(glb.data() + 8, &whole, sizeof whole);
    std::memcpy(glb.data() + 12, &new_length, sizeof new_length);
    return glb;
}

/// Measures views under a probe, prints the table, and holds: jumps of at most 4 %, or little more than the content's
/// own, and still pictures within 5 % of those of 16 samples. The wing cases mirror lamps a thousand times as bright as
/// white, whose images one look-up per pixel widens: they are held to 8 %, up to white. On the record a lamp's orders
/// lie five pixels apart: 5.4 % at most, held to 6.
void hold_goals(Shimmer& shimmer, const demo::Options& options, const std::string& probe,
                const std::vector<std::size_t>& views) {
    shimmer.session().use_probe(options.cooked_folder / (probe + ".probe"));
    const auto cameras = shimmer.session().scene().views();
    for (const std::size_t view : views)
        for (const auto& [object, found] : shimmer.measure(cameras[view], true)) {
            const std::string where = fmt::format("{}, view {}, {}", probe, view, object);
            fmt::print(
                "{:36} {:6} pixels  jump {:4.1f} % (content {:4.1f} %)  error {:5.1f} %  up to white {:5.1f} %\n",
                where, found.pixels, 100.0 * found.jumping, 100.0 * found.content_jumping, 100.0 * found.error,
                100.0 * found.displayed);
            EXPECT_LE(found.jumping, std::max(Shimmer::kCalm, found.content_jumping + 0.025)) << where;
            if (object == "wing cases")
                EXPECT_LE(found.displayed, 0.08) << where;
            else
                EXPECT_LE(found.error, object == "record" ? 0.06 : 0.05) << where;
        }
}

/// Two views, and the opening one under the captures, where there are any, under which the most pixels jump.
TEST(Shimmer, PixelsOfTheCabinetsGratingsShowWhatTheyCover) {
    const platform::HeadlessContext context;
    const demo::Options options = cabinet();
    Shimmer shimmer(options, kSize);
    hold_goals(shimmer, options, "studio", {0, 3});
    hold_goals(shimmer, options, "clear_sky", {3});
    hold_goals(shimmer, options, "night", {0});
    for (const std::string probe : {"captured_night", "captured_studio"})
        if (std::filesystem::exists(options.cooked_folder / (probe + ".probe")))
            hold_goals(shimmer, options, probe, {0});
}

TEST(Shimmer, OfAFoilThatSparklesIsMore) {
    const platform::HeadlessContext context;
    const test::TemporaryFolder folder;
    demo::Options options = cabinet();
    const std::vector<std::byte> glb = read_file(*options.scene, 1 << 26);
    const std::string text(reinterpret_cast<const char*>(glb.data()), glb.size());
    const auto change = [&](const demo::Options& scene) {
        Shimmer shimmer(scene, kSize / 2);
        return shimmer.measure(shimmer.session().scene().views()[0], false).at(kFoil).change;
    };
    const double filtered = change(options);
    options.scene = folder.path() / "sparkle.glb";
    write_file_atomic(*options.scene, with_json(text, R"("grooveTexture":{"index":0})",
                                                R"("grooveTexture":{"index":0,"sparkle":true})"));
    EXPECT_GT(change(options), filtered);
}

}  // namespace
}  // namespace rowland
