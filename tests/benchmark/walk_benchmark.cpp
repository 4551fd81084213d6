// A walk through the three rooms: how the picture changes from frame to frame under many probes, and how far gratings
// are from the reference under the light of their position.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/pixel/surface_point.h"
#include "engine/colour/illuminant.h"
#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "engine/gpu/framebuffer.h"
#include "engine/platform/gl_context.h"
#include "engine/render/capture.h"
#include "engine/render/gpu_mesh.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/vertex_light.h"
#include "tests/benchmark/walk_budgets.h"
#include "tests/benchmark/walk_rooms.h"

namespace rowland {
namespace {

using namespace benchmark;
using Pixels = std::vector<glm::vec4>;

/// The box about a point of the path.
std::size_t box_at(const render::ProbeVolumes& volumes, float x) {
    const render::LightMix mix = render::light_at({x, kEyeHeight_m, 0.0F}, volumes.boxes);
    const std::size_t probe = mix.second_part > 0.5F ? mix.second : mix.first;
    ROWLAND_CHECK(probe > 0, "a box about each door");
    return probe - 1;
}

struct Walk {
    double largest_step = 0.0;  ///< of a display value, in 1/255
    /// RMS over the pixels where the carried gratings are, in 1/255: of the median frame and of the largest.
    double carried_median = 0.0;
    double carried_largest = 0.0;
    double middle_ms = 0.0;  ///< median of the frames' times
    double longest_ms = 0.0;
    int filling = 0;  ///< frames after the first in which maps were not filled
};

/// `white`: the radiance that is shown as white.
Walk walk_through(Rooms& rooms, const WalkOptions& options, float door_m, double white) {
    const gpu::Framebuffer target(
        {.width = options.size.x, .height = options.size.y, .colours = {gpu::Format::RGBA32F}, .depth = true});
    Walk walk;
    std::vector<double> times;
    std::vector<double> carried_steps;
    Pixels before;
    for (int frame = 0; frame < options.frames; ++frame) {
        const float x = door_m - 1.0F + 2.0F * static_cast<float>(frame) / static_cast<float>(options.frames - 1);
        const scene::Camera camera = camera_at(x, {1.0F, 0.0F, 0.0F});
        rooms.carry_at(camera);
        if (frame == 0)
            for (rooms.draw_ms(camera, target); diffraction::maps_are_filling(rooms.world());)
                rooms.draw_ms(camera, target);
        times.push_back(rooms.draw_ms(camera, target));
        if (diffraction::maps_are_filling(rooms.world())) ++walk.filling;
        Pixels pixels = target.read_rgba_float();
        double squares = 0.0;
        int values = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const auto column = static_cast<int>(i) % options.size.x;
            const auto row = static_cast<int>(i) / options.size.x;
            // The carried gratings fill the middle of the picture.
            const bool carried = std::abs(2 * column - options.size.x) < options.size.y / 2 &&
                                 std::abs(2 * row - options.size.y) < options.size.y / 5;
            for (int c = 0; c < 3; ++c) {
                const double step = std::abs(display_value(pixels[i][c], white) - display_value(before[i][c], white));
                walk.largest_step = std::max(walk.largest_step, step);
                if (!carried) continue;
                squares += step * step;
                ++values;
            }
        }
        if (values > 0) carried_steps.push_back(std::sqrt(squares / values));
        before = std::move(pixels);
    }
    walk.longest_ms = *std::ranges::max_element(times);
    walk.carried_median = diffraction::quantile(carried_steps, 0.5);
    walk.carried_largest = diffraction::quantile(carried_steps, 1.0);
    walk.middle_ms = diffraction::quantile(times, 0.5);
    return walk;
}

void walk_through_doors(const WalkOptions& options) {
    std::printf("%d frames through each door, %d × %d; steps of a display value in 1/255\n", options.frames,
                options.size.x, options.size.y);
    std::printf("%6s %-10s %8s %15s %8s %9s %8s %8s\n", "door", "probes", "largest", "carried: median", "largest",
                "median ms", "longest", "filling");
    for (const float door_m : kDoors_m) {
        Rooms many(options, std::nullopt);
        const std::size_t at_door = box_at(many.volumes(), door_m);
        Rooms one(options, at_door);
        const gpu::Framebuffer target(
            {.width = options.size.x, .height = options.size.y, .colours = {gpu::Format::RGBA32F}, .depth = true});
        one.draw_ms(camera_at(door_m - 1.0F, {1.0F, 0.0F, 0.0F}), target);
        const double white = white_of(target.read_rgba_float());
        std::map<std::string, Walk> walks;
        for (const auto& [name, rooms] : {std::pair("one", &one), std::pair("many", &many)}) {
            rooms->carry_gratings();
            const Walk& walk = walks[name] = walk_through(*rooms, options, door_m, white);
            std::printf("%6.1f %-10s %8.1f %15.2f %8.2f %9.1f %8.1f %8d\n", static_cast<double>(door_m), name,
                        walk.largest_step, walk.carried_median, walk.carried_largest, walk.middle_ms, walk.longest_ms,
                        walk.filling);
        }
        std::printf("%6.1f %-10s %8.2f\n", static_cast<double>(door_m), "many ÷ one",
                    walks["many"].largest_step / walks["one"].largest_step);
        std::fflush(stdout);
    }
}

/// A point of a grating that is seen from a stop of the walk.
struct SeenPoint {
    int stop = 0;
    std::shared_ptr<const diffraction::CookedMaterial> cooked;
    diffraction::GrooveLayout layout{};
    diffraction::ShadingPoint frame;
    glm::vec3 centre{0.0F};  ///< of the object's bounds
    render::LightMix light;
    glm::dvec3 shown{0.0};
    glm::dvec3 reference{0.0};  ///< under the mixed light
};

/// At most `kPoints` points per stop, each of another grating without a groove texture.
std::vector<SeenPoint> seen_points(Rooms& rooms, const WalkOptions& options) {
    constexpr glm::ivec2 kTexels(64, 36);
    constexpr std::size_t kPoints = 4;
    std::vector<demo::PlacedMesh> meshes;
    std::vector<ecs::Entity> entities;
    rooms.world().view<render::MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const render::MeshInstance& mesh, const scene::WorldMatrix& matrix) {
            meshes.push_back({mesh.mesh, matrix.matrix});
            entities.push_back(entity);
        });
    std::vector<SeenPoint> points;
    std::mt19937 random(7);
    for (int stop = 0; stop < options.stops; ++stop) {
        const scene::Camera camera = camera_at_stop(stop, options.stops);
        auto texels = demo::visible_points(camera, kTexels, meshes);
        std::ranges::shuffle(texels, random);
        std::vector<std::size_t> taken;
        for (const auto& texel : texels) {
            if (!texel || taken.size() == kPoints || std::ranges::find(taken, texel->mesh) != taken.end()) continue;
            const ecs::Entity entity = entities[texel->mesh];
            const auto grating = demo::placed_grating(rooms.world(), entity);
            const auto* surface = rooms.world().find<diffraction::DiffractionSurface>(entity);
            if (!grating || surface->grooves) continue;
            const auto frame = demo::frame_at(*grating, texel->hit, texel->point, camera.eye);
            if (!frame) continue;
            const auto& instance = rooms.world().get<render::MeshInstance>(entity);
            const scene::Bounds bounds = render::transformed(instance.gpu->bounds(), grating->to_world);
            SeenPoint point{.stop = stop,
                            .cooked = surface->material->cooked(),
                            .layout = diffraction::groove_layout(*grating->mesh, false, false),
                            .frame = *frame,
                            .centre = 0.5F * (bounds.minimum + bounds.maximum),
                            .light = {}};
            point.light = render::light_at(point.centre, rooms.volumes().boxes);
            if (point.light.first == 0) continue;  // partly the light far away
            taken.push_back(texel->mesh);
            points.push_back(point);
        }
    }
    return points;
}

glm::dvec3 reference_under(const lighting::ProbeImage& light, const SeenPoint& point) {
    const diffraction::Material& material = point.cooked->material;
    return diffraction::reference_radiance(material.grating, light, colour::LightSpectra(material.quality.illuminant),
                                           {{point.frame}})[0];
}

/// Adds what each point shows, and what the reference shows, under the captured light of its probes.
void compare(const std::vector<lighting::ProbeImage>& lights, std::vector<SeenPoint>& points) {
    const int key_lights = lighting::LightProbeSettings{}.key_lights;
    Progress progress("comparing", lights.size());
    for (std::size_t probe = 0; probe < lights.size(); ++probe) {
        std::optional<diffraction::PointComparer> comparer;
        for (SeenPoint& point : points) {
            const double second = static_cast<double>(point.light.second_part);
            const double part = point.light.first == probe + 1                    ? 1.0 - second
                                : second > 0.0 && point.light.second == probe + 1 ? second
                                                                                  : 0.0;
            if (part == 0.0) continue;
            if (!comparer) comparer.emplace(lights[probe], key_lights);
            const math::SphericalWindow window =
                demo::chosen_window(*comparer, *point.cooked, point.layout,
                                    std::min(point.cooked->material.quality.key_lights, key_lights));
            const auto compared = comparer->compare(point.cooked, window, point.frame, point.layout);
            point.shown += part * compared.shown;
            point.reference += part * compared.reference;
        }
        progress.advance();
    }
}

struct Errors {
    std::vector<glm::dvec3> shown;
    std::vector<glm::dvec3> reference;
    void print(const char* what) const {
        if (shown.empty()) return;
        std::printf("%-64s %6zu %9.2f %%\n", what, shown.size(), 100.0 * diffraction::relative_rms(shown, reference));
    }
};

void compare_at_stops(const WalkOptions& options) {
    Rooms rooms(options, std::nullopt);
    std::vector<SeenPoint> points = seen_points(rooms, options);
    rooms.remove_boxes();
    std::vector<lighting::ProbeImage> lights;
    for (const render::ProbeBox& box : rooms.volumes().boxes)
        lights.push_back(render::capture_surroundings(rooms.renderer(), rooms.world(), glm::vec3(box.box_to_world[3]),
                                                      options.face_size));
    compare(lights, points);
    Errors all;
    Errors between;
    Errors captured_one;
    Errors captured_two;
    std::map<int, Errors> of_stop;
    Progress progress("capturing", points.size());
    for (const SeenPoint& point : points) {
        const auto add = [&](Errors& errors) {
            errors.shown.push_back(point.shown);
            errors.reference.push_back(point.reference);
        };
        add(all);
        add(of_stop[point.stop]);
        if (point.light.has_second()) add(between);
        Errors& captured = point.light.has_second() ? captured_two : captured_one;
        captured.shown.push_back(point.reference);
        captured.reference.push_back(reference_under(
            render::capture_surroundings(rooms.renderer(), rooms.world(), point.centre, options.face_size), point));
        progress.advance();
    }
    std::printf("\n%-64s %6s %11s\n", "relative RMS error of gratings' XYZ, so many", "points", "");
    all.print("against the reference under their probes' light");
    between.print("of these, of objects between two probes");
    captured_one.print("reference under one probe against that under the object's own");
    captured_two.print("reference under two, mixed, against that under the object's own");
    std::vector<double> errors;
    for (const auto& [stop, of] : of_stop) errors.push_back(diffraction::relative_rms(of.shown, of.reference));
    std::printf("stops: %zu, median %.2f %%, worst %.2f %%\n", errors.size(),
                100.0 * diffraction::quantile(errors, 0.5), 100.0 * diffraction::quantile(errors, 1.0));
}

int run(int argc, char** argv) {
    WalkOptions options;
    options.scene = program_prefix() / "cooked" / "rooms.scene";
    CLI::App app{"A walk through the three rooms, under a probe for each box and under one.", "rowland-walk-benchmark"};
    app.footer(
        "Needs the rooms: ./rowland rooms, or the target rowland-rooms.\nexample: rowland-walk-benchmark --frames 50");
    app.add_option("--frames", options.frames, "Frames through each door; 0: skip them")
        ->check(CLI::Range(0, 10000))
        ->capture_default_str();
    app.add_option("--stops", options.stops,
                   "Stops of the walk at which gratings are compared with the reference; 0: none")
        ->check(CLI::Range(0, 10000))
        ->capture_default_str();
    int budget_stops = 0;
    std::optional<std::filesystem::path> json;
    app.add_option("--budget-stops", budget_stops,
                   "Stops of the walk at which frames are drawn within budgets; 0: none")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    app.add_option("--json", json, "Write what the budgets gave to a file")->type_name("FILE");
    app.add_option("--width", options.size.x, "Width in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    app.add_option("--height", options.size.y, "Height in pixels")->check(CLI::Range(16, 8192))->capture_default_str();
    if (!parse_command_line(app, argc, argv)) return 0;
    if (!std::filesystem::exists(options.scene))
        fail_system(options.scene.string(), "no such file", "build it: ./rowland rooms --help");
    if (json) check_outputs(std::array{options.scene}, std::array{Output{"--json", *json, ".json"}});
    const platform::HeadlessContext context;
    if (budget_stops > 0) {
        const std::vector<BudgetFrames> budgets = draw_under_budgets(options, budget_stops);
        print_budgets(budgets);
        if (json) write_file_atomic(*json, budgets_json(budgets).dump(1) + '\n');
    }
    if (options.frames > 0) walk_through_doors(options);
    if (options.stops > 0) compare_at_stops(options);
    return 0;
}

}  // namespace
}  // namespace rowland

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::run(argc, argv); });
}
