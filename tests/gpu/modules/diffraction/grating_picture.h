#pragma once

// Pictures of gratings against the CPU: what the tests of all representations share.

#include <chrono>

#include "engine/render/renderer.h"
#include "modules/diffraction/module.h"
#include "tests/gpu/gl_test.h"
#include "tests/gpu/modules/diffraction/filter_error.h"
#include "tests/gpu/modules/diffraction/key_light_reference.h"

namespace rowland::diffraction {

inline constexpr const char* kSlitCd = R"({"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}})";
inline constexpr const char* kBlazed =
    R"({"pitch_nm": 1200, "profile": {"type": "blazed", "depth_nm": 250}, "orders": [-1, 1, 2]})";
inline constexpr const char* kFoil = R"({"pitch_nm": 1000, "profile": {"type": "sinusoidal", "depth_nm": 150},
                                         "groove_lobe": {"sigma": 0.3}})";
inline constexpr const char* kPits = R"({"pitch_nm": 1500, "profile": {"type": "slit", "width_nm": 700},
                                         "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}}})";

inline constexpr const char* kPitSequence = R"({"pitch_nm": 1500, "profile": {"type": "slit", "width_nm": 700},
    "groove_lobe": {"pit_sequence": {"spacings_nm": [900, 1800, 3300], "coherent": 0.3, "sigma": 0.03}}})";

/// A material of these two JSON objects, and further members.
CookedMaterial cook(const std::string& grating, const std::string& quality, const std::string& others = "");

/// A grating whose table of orders carries all light, so that nothing is left for the base; as a blazed one's.
CookedMaterial cook_complete(const std::string& grating, const std::string& quality, const std::string& others = "");

/// A planar material of these settings, with a stand-in of few views, as many are slow to bake for a lobe.
CookedMaterial cook_planar(const std::string& grating, const std::string& settings);

/// A smooth probe: no radiance is below 0, nor does it change within a few texels.
lighting::ProbeImage smooth_probe();

/// Three key lights, from wide to narrow.
std::vector<lighting::KeyLight> three_keys();

/// A frame's light, and what references on the CPU read of it.
struct GratingLight {
    std::shared_ptr<const lighting::LightProbe> probe = {};
    std::vector<lighting::KeyLight> key_lights = {};
    lighting::ShLight sh = {};                                        ///< the whole probe
    lighting::ShLight residual = {};                                  ///< without `key_lights`
    std::shared_ptr<const lighting::LightSamples> probe_texels = {};  ///< the whole probe
    std::shared_ptr<const lighting::LightSamples> texels = {};        ///< without `key_lights`
    std::uint64_t version = 0;

    render::FrameLight frame() const { return {.probe = probe, .analytic_key_lights = true, .version = version}; }
};

/// A probe with key lights added to it.
GratingLight light_of(const lighting::ProbeImage& probe, std::vector<lighting::KeyLight> keys,
                      std::uint64_t version = 1);

/// A probe without any light.
GratingLight black_light();

/// Of the picture's maximum: 5e-4 of tables in halves, and 1.5e-3 of the kernel, whose table has more columns on the
/// CPU. Tables of views change little from texel to texel: positions of 8 bits between them (filter_error.h) add 4e-4.
inline constexpr double kPictureTolerance = 2e-3;
/// The same of a map alone, in halves or of values as_stored().
inline constexpr double kMapTolerance = 5e-4;

/// A map with the values of its texture: those of planar maps are rounded to RGB9_E5, unless light was subtracted.
PlanarMap as_stored(PlanarMap map, const lighting::LightSamples& light);
LobeMap as_stored(LobeMap map, const lighting::LightSamples& light);
template <typename Map>
Map as_stored(Map map, const lighting::LightSamples& /*light*/) {
    return map;
}

/// One triangle with a grating, drawn as XYZ unless a test sets another working space.
class GratingPicture : public rowland::test::GlTest, protected DrawnTriangle {
 protected:
    /// The probe with the same radiance from everywhere in its reflections, and black SH if it has none.
    static lighting::LightProbe with_even_environment(lighting::LightProbe probe, float radiance);

    /// Builds the scene, from the mesh and the light as they are. While its triangle is alive, gives it another
    /// material.
    void show(const CookedMaterial& cooked, double groove_rotation = 0.0, MapPace pace = MapPace::Whole,
              std::chrono::milliseconds map_wait = std::chrono::hours(1));
    /// Gives the triangle another material.
    void use(const CookedMaterial& cooked);
    /// Rows from the top down.
    std::vector<glm::vec4> draw();

    /// XYZ of a point on the CPU, or the error that texture units may add to it (filter_error.h).
    using AtPoint = std::function<glm::dvec3(const Point&)>;

    /// What an arc table gives, its products interpolated between the vertices.
    AtPoint arc_xyz(const CookedMaterial& cooked, const lighting::ShLight& light);
    /// What a table gives that is evaluated at the vertices.
    template <typename Table>
    AtPoint table_xyz(const CookedMaterial& cooked, const lighting::ShLight& light) {
        const auto& table = std::get<Table>(cooked.tables);
        std::vector<glm::dvec3> vertices;
        for (std::size_t vertex = 0; vertex < 3; ++vertex)
            vertices.push_back(evaluate(table, vertex_light(vertex, light, table.bands), vertex_view(vertex)));
        return [vertices](const Point& point) { return mix(point, vertices); };
    }

    /// What a map gives.
    template <typename Map>
    static AtPoint map_xyz(const Map& map) {
        return [shared = std::make_shared<const Map>(map)](const Point& point) {
            const glm::dmat3 axes = glm::transpose(point.to_tangent);
            return sample(*shared, ShadingPoint{.view = axes * point.view, .normal = axes[2], .grating = axes[0]});
        };
    }
    /// The same of a map that is filled from the light.
    template <typename Map>
    AtPoint stored_xyz(const Map& map) const {
        return map_xyz(as_stored(map, *light_.texels));
    }
    /// What the light's key lights give, and the error that texture units may add. `cooked` must outlive them.
    AtPoint key_lights(const CookedMaterial& cooked) const {
        return [this, &cooked](const Point& point) { return key_light_xyz(cooked, light_.key_lights, point); };
    }
    AtPoint key_lights_error(const CookedMaterial& cooked) const {
        return [this, &cooked](const Point& point) { return key_light_error(cooked, light_.key_lights, point); };
    }
    static AtPoint sum(const AtPoint& a, const AtPoint& b) {
        return [a, b](const Point& point) { return a(point) + b(point); };
    }

    /// Draws a material whose map is looked up at the vertices, and its key lights at the vertices or at the pixels.
    template <typename Map>
    void expect_map_at_vertices(const CookedMaterial& cooked, const Map& map) {
        expect_map_at_vertices(cooked, stored_xyz(map), map_xyz(filter_error(map)));
    }
    void expect_map_at_vertices(const CookedMaterial& cooked, const AtPoint& map_xyz, const AtPoint& map_error);

    /// Draws, and expects a picture that is not dark and differs from `expected` by less than `tolerance`:
    /// largest_difference().
    void expect_drawn(const AtPoint& expected, const AtPoint& allowed = nullptr, double tolerance = kPictureTolerance);
    /// The same of a map alone.
    template <typename Map>
    void expect_map(const Map& map) {
        expect_drawn(stored_xyz(map), map_xyz(filter_error(map)), kMapTolerance);
    }
    /// Of a map, and key lights over it.
    template <typename Map>
    void expect_map_and_lights(const CookedMaterial& cooked, const Map& map) {
        expect_drawn(sum(stored_xyz(map), key_lights(cooked)), sum(map_xyz(filter_error(map)), key_lights_error(cooked)));
    }

    /// Largest difference between the picture and `expected` beyond `allowed`, over the picture's largest component.
    double largest_difference(const std::vector<glm::vec4>& pixels, const AtPoint& expected,
                              const AtPoint& allowed = nullptr);
    /// The largest component of a picture.
    static float brightest(const std::vector<glm::vec4>& pixels);
    /// Largest difference between two pictures, over the largest component of `a`.
    static double largest_difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b);

    /// The triangle's plane is seen at 0.5 degrees.
    void look_along_the_surface();

    glm::dmat3 xyz_to_working_{1.0};
    std::optional<render::Renderer> renderer_;
    ecs::World world_;
    ecs::Entity entity_;
    GratingLight light_ = light_of(smooth_probe(), {});
    std::shared_ptr<const GpuMaterial> material_;
    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true}};
    double brightest_ = 0.0;
    int compared_ = 0;
};

}  // namespace rowland::diffraction
