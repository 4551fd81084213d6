// Pixels average what they cover: pictures equal supersampled ones, and hold still while the camera moves by less than
// a pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
#include "engine/gpu/framebuffer.h"
#include "engine/platform/gl_context.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/demo/demo_session.h"

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

struct ViewAverage {
    std::map<std::string, PixelAverage> gratings;  ///< by the objects' names
    /// Pixels at outlines, away from gratings, that are more than twice as bright as the 3 x 3 pixels of 16 samples
    /// around them.
    std::size_t dots = 0;
};

/// Measures the gratings of the demo's scene.
class Shimmer {
 public:
    Shimmer(const demo::Options& options, glm::ivec2 size);

    /// Fraction of pixels whose jumping is small.
    static constexpr double kCalm = 0.04;

    /// `with_error`: draws pictures of 16 samples as well.
    ViewAverage measure(const scene::Camera& camera, bool with_error);

    demo::Session& session() { return session_; }
    /// Lights the scene and fills its maps, which do not depend on the camera.
    void use_probe(const std::filesystem::path& probe);

 private:
    using Pixels = std::vector<glm::vec4>;
    /// An object in the picture.
    struct Seen {
        std::vector<std::size_t> pixels;  ///< without those at its edges
        glm::vec3 sum{0.0F};              ///< of their points in the world
    };

    struct View {
        std::map<std::string, Seen> gratings;
        std::vector<std::size_t> outlines;  ///< of any objects, away from gratings
    };

    Pixels draw(const scene::Camera& camera);
    Pixels draw_supersampled(const scene::Camera& camera);
    View see(const scene::Camera& camera);
    std::size_t dots(const std::vector<std::size_t>& at, const Pixels& picture, const Pixels& reference) const;

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

void Shimmer::use_probe(const std::filesystem::path& probe) {
    session_.use_probe(probe);
    session_.picture().resize({16, 9});
    // A map is full in the second frame at rest.
    for (int frame = 0; frame < 2 || diffraction::maps_are_filling(session_.play().world()); ++frame)
        session_.draw_from(session_.scene().camera(), 0.0F);
    session_.picture().resize(size_);
}

Shimmer::Pixels Shimmer::draw(const scene::Camera& camera) {
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

Shimmer::View Shimmer::see(const scene::Camera& camera) {
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
    View result;
    for (int row = 1; row + 1 < size_.y; ++row)
        for (int column = 1; column + 1 < size_.x; ++column) {
            const auto& here = points[at(row, column)];
            bool inner = true;
            bool near_grating = false;
            for (int i = 0; i < 9; ++i) {
                const auto& beside = points[at(row + i / 3 - 1, column + i % 3 - 1)];
                inner = inner && beside.has_value() == here.has_value() && (!here || beside->mesh == here->mesh);
                near_grating = near_grating || (beside && !gratings[beside->mesh].empty());
            }
            if (!inner && !near_grating) result.outlines.push_back(at(row, column));
            if (!inner || !here || gratings[here->mesh].empty()) continue;
            Seen& seen = result.gratings[gratings[here->mesh]];
            seen.pixels.push_back(at(row, column));
            seen.sum += here->point;
        }
    return result;
}

std::size_t Shimmer::dots(const std::vector<std::size_t>& at, const Pixels& picture, const Pixels& reference) const {
    constexpr float kDark = 0.05F;
    const auto brightness = [](const glm::vec4& pixel) { return std::max({pixel.r, pixel.g, pixel.b}); };
    return static_cast<std::size_t>(std::ranges::count_if(at, [&](std::size_t i) {
        float brightest = 0.0F;
        for (std::size_t beside = 0; beside < 9; ++beside) {
            const std::size_t above = i - static_cast<std::size_t>(size_.x) - 1;
            const std::size_t row = beside / 3 * static_cast<std::size_t>(size_.x);
            brightest = std::max(brightest, brightness(reference[above + row + beside % 3]));
        }
        return brightness(picture[i]) > 2.0F * brightest + kDark;
    }));
}

ViewAverage Shimmer::measure(const scene::Camera& camera, bool with_error) {
    const Pixels picture = draw(camera);
    const Pixels reference = with_error ? draw_supersampled(camera) : picture;
    const View view = see(camera);
    ViewAverage result{.gratings = {}, .dots = dots(view.outlines, picture, reference)};
    for (const auto& [object, seen] : view.gratings) {
        const glm::vec3 middle = seen.sum / static_cast<float>(seen.pixels.size());
        const scene::Camera aside = moved(camera, size_.y, middle);
        const Pixels next = draw(aside);
        const double jumping = fraction_jumping(seen.pixels, picture, next);
        double content_jumping = 0.0;
        if (with_error && jumping > kCalm)
            content_jumping = fraction_jumping(seen.pixels, reference, draw_supersampled(aside));
        result.gratings[object] = {.pixels = seen.pixels.size(),
                                   .jumping = jumping,
                                   .change = relative_rms(seen.pixels, next, picture, kWhite),
                                   .content_jumping = content_jumping,
                                   .error = relative_rms(seen.pixels, picture, reference, kNoWhite),
                                   .displayed = relative_rms(seen.pixels, picture, reference, kWhite)};
    }
    return result;
}

/// Six tenths of the width and height of a picture of 1280 × 720, with its pixels.
constexpr float kMiddle = 0.6F;
constexpr glm::ivec2 kSize{768, 432};

/// The part of a view that holds the gratings: its middle, a tenth of the height lower.
scene::Camera at_gratings(scene::Camera view) {
    const float tangent = std::tan(0.5F * view.vertical_field_of_view);
    const float tenth = 0.2F * tangent * glm::distance(view.eye, view.target);
    view.target -= tenth * glm::vec3(glm::row(view.view(), 1));
    view.vertical_field_of_view = 2.0F * std::atan(kMiddle * tangent);
    return view;
}

/// Measures views under a probe, prints the table, and holds: jumps of at most 4 %, or little more than the content's
/// own, and still pictures within 5 % of those of 16 samples. The wing cases have striae and punctures finer than the
/// pixels of these views, whose lobes are as wide in all directions: 23 % off at most, up to white, and 6 % more jumps
/// than their content has; held to 24 and 6.5. On the record a lamp's orders lie five pixels apart: 6.6 % at most, held
/// to 7. At outlines two pixels are dots at most, held to 3; seven were when thin legs had the lobe of one of their
/// normals.
void hold_goals(Shimmer& shimmer, const demo::Options& options, const std::string& probe,
                const std::vector<std::size_t>& views) {
    shimmer.use_probe(options.cooked_folder / (probe + ".probe"));
    const auto cameras = shimmer.session().scene().views();
    for (const std::size_t view : views) {
        const ViewAverage measured = shimmer.measure(at_gratings(cameras[view]), true);
        fmt::print("{}, view {}: {} dots\n", probe, view, measured.dots);
        EXPECT_LE(measured.dots, 3U) << probe << ", view " << view;
        for (const auto& [object, found] : measured.gratings) {
            const std::string where = fmt::format("{}, view {}, {}", probe, view, object);
            fmt::print(
                "{:36} {:6} pixels  jump {:4.1f} % (content {:4.1f} %)  error {:5.1f} %  up to white {:5.1f} %\n",
                where, found.pixels, 100.0 * found.jumping, 100.0 * found.content_jumping, 100.0 * found.error,
                100.0 * found.displayed);
            const double more = object == "wing cases" ? 0.065 : 0.025;
            EXPECT_LE(found.jumping, std::max(Shimmer::kCalm, found.content_jumping + more)) << where;
            if (object == "glitter card") continue;  // as many sparks as its facets have, but not where they have them
            if (object == "wing cases")
                EXPECT_LE(found.displayed, 0.24) << where;
            else
                EXPECT_LE(found.error, object == "record" ? 0.07 : 0.05) << where;
        }
    }
}

/// The opening view under the probes, a capture where there is one, under which the most pixels jump; another under
/// lamps.
TEST(Shimmer, PixelsOfTheCabinetsGratingsShowWhatTheyCover) {
    const platform::HeadlessContext context;
    const demo::Options options = test::cabinet_options();
    Shimmer shimmer(options, kSize);
    hold_goals(shimmer, options, "studio", {3});
    hold_goals(shimmer, options, "night", {0});
    if (std::filesystem::exists(options.cooked_folder / "captured_studio.probe"))
        hold_goals(shimmer, options, "captured_studio", {0});
}

}  // namespace
}  // namespace rowland
