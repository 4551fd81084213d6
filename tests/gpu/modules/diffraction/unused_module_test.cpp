// What a scene does not use costs it nothing, by what the driver is told.

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/module.h"
#include "tests/gpu/render_test.h"
#include "tests/support/replaced_function.h"

namespace rowland::diffraction {
namespace {

/// What goes to the GPU, as the driver is told.
struct Told {
    std::size_t bytes = 0;  ///< of buffers and texels
    std::vector<std::string> shaders;
};
Told* log = nullptr;

std::size_t components(GLenum format) {
    switch (format) {
        case GL_RED:
            return 1;
        case GL_RG:
            return 2;
        case GL_RGB:
            return 3;
        case GL_RGBA:
            return 4;
        default:
            check_failed(__FILE__, __LINE__, "a pixel format that is counted");
    }
}

std::size_t texel_bytes(GLenum format, GLenum type) {
    switch (type) {
        case GL_UNSIGNED_BYTE:
            return components(format);
        case GL_UNSIGNED_SHORT:
        case GL_HALF_FLOAT:
            return 2 * components(format);
        case GL_FLOAT:
            return 4 * components(format);
        default:
            check_failed(__FILE__, __LINE__, "a pixel type that is counted");
    }
}

void count_texels(GLsizei width, GLsizei height, GLsizei depth, GLenum format, GLenum type) {
    log->bytes += static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(depth) *
                  texel_bytes(format, type);
}

void APIENTRY buffer_storage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags) {
    log->bytes += static_cast<std::size_t>(size);
    rowland::test::ReplacedFunction<&epoxy_glNamedBufferStorage>::driver(buffer, size, data, flags);
}

void APIENTRY buffer_part(GLuint buffer, GLintptr offset, GLsizeiptr size, const void* data) {
    log->bytes += static_cast<std::size_t>(size);
    rowland::test::ReplacedFunction<&epoxy_glNamedBufferSubData>::driver(buffer, offset, size, data);
}

void APIENTRY line(GLuint texture, GLint level, GLint x, GLsizei width, GLenum format, GLenum type,
                   const void* texels) {
    count_texels(width, 1, 1, format, type);
    rowland::test::ReplacedFunction<&epoxy_glTextureSubImage1D>::driver(texture, level, x, width, format, type, texels);
}

void APIENTRY plane(GLuint texture, GLint level, GLint x, GLint y, GLsizei width, GLsizei height, GLenum format,
                    GLenum type, const void* texels) {
    count_texels(width, height, 1, format, type);
    rowland::test::ReplacedFunction<&epoxy_glTextureSubImage2D>::driver(texture, level, x, y, width, height, format,
                                                                        type, texels);
}

void APIENTRY volume(GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width, GLsizei height,
                     GLsizei depth, GLenum format, GLenum type, const void* texels) {
    count_texels(width, height, depth, format, type);
    rowland::test::ReplacedFunction<&epoxy_glTextureSubImage3D>::driver(texture, level, x, y, z, width, height, depth,
                                                                        format, type, texels);
}

void APIENTRY record_source(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    log->shaders.push_back(rowland::test::whole_source(count, texts, lengths));
    rowland::test::ReplacedFunction<&epoxy_glShaderSource>::driver(shader, count, texts, lengths);
}

/// While it lives, stands between the program and OpenGL. One at a time, on a thread whose context is current.
class UploadLog {
 public:
    UploadLog() { log = &told_; }
    ~UploadLog() { log = nullptr; }
    UploadLog(const UploadLog&) = delete;
    UploadLog& operator=(const UploadLog&) = delete;

    const Told& told() const { return told_; }

 private:
    template <auto Pointer>
    using Replaced = rowland::test::ReplacedFunction<Pointer>;

    Told told_;
    Replaced<&epoxy_glNamedBufferStorage> storage_{"glNamedBufferStorage", buffer_storage};
    Replaced<&epoxy_glNamedBufferSubData> part_{"glNamedBufferSubData", buffer_part};
    Replaced<&epoxy_glTextureSubImage1D> line_{"glTextureSubImage1D", line};
    Replaced<&epoxy_glTextureSubImage2D> plane_{"glTextureSubImage2D", plane};
    Replaced<&epoxy_glTextureSubImage3D> volume_{"glTextureSubImage3D", volume};
    Replaced<&epoxy_glShaderSource> source_{"glShaderSource", record_source};
};

class UnusedModule : public rowland::test::RenderTest {
 protected:
    /// What three frames of a lit square tell the driver. `material`: a grating's file, or none for a plain surface.
    Told frames(bool with_module, const char* material = nullptr) {
        const UploadLog uploads;
        render::Renderer renderer(glm::dmat3(1.0));
        if (with_module) register_module(renderer);
        renderer.use_key_lights(true);
        lighting::LightProbe probe = even_light(0.5F);
        probe.key_lights = {{.direction = {0.0, 0.6, 0.8}, .flux = glm::dvec3(0.4), .concentration = 900.0}};
        renderer.set_probe(probe);
        ecs::World world;
        const ecs::Entity square = world.create();
        world.add(square, render::make_mesh_instance(RenderTest::square()));
        world.add(square, render::StandardMaterial{});
        world.add(square, scene::Transform{});
        world.add(world.create(), scene::DirectionalLight{.casts_shadow = true});
        const ecs::Entity lamp = world.create();
        world.add(lamp, scene::PunctualLight{});
        world.add(lamp, scene::Transform{.translation = {0.0F, 0.0F, 2.0F}});
        if (material != nullptr) {
            const Material parsed = parse_material(nlohmann::json::parse(material), "grating.json");
            world.add(square, DiffractionSurface{make_gpu_material(bake_material(parsed), glm::dmat3(1.0))});
        }
        for (int frame = 0; frame < 3; ++frame) {
            world.get<scene::Transform>(square).rotation =
                glm::angleAxis(0.1F * static_cast<float>(frame), glm::vec3(0.0F, 1.0F, 0.0F));
            scene::update_world_matrices(world);
            renderer.render(world, camera_, target_);
        }
        return uploads.told();
    }
};

TEST_F(UnusedModule, ASceneWithoutGratingsUploadsAndCompilesNothingOfIt) {
    const Told without = frames(false);
    const Told with = frames(true);
    EXPECT_GT(without.bytes, 0U);
    EXPECT_EQ(with.bytes, without.bytes);
    EXPECT_FALSE(without.shaders.empty());
    EXPECT_EQ(with.shaders, without.shaders);
}

/// One representation's shaders, and its tables once.
TEST_F(UnusedModule, AGratingUploadsAndCompilesWhatItNeeds) {
    const Told without = frames(false);
    const Told grating = frames(true, R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}},
                                          "quality": {"representation": "arc", "key_lights": 0}})");
    const std::size_t table = std::size_t{256} * 2 * 4 * 2;  // texels of halves
    EXPECT_GE(grating.bytes, without.bytes + table);
    std::size_t arcs = 0;
    for (const std::string& source : grating.shaders) {
        if (source.find("arc_radiance") != std::string::npos) ++arcs;
        for (const char* other : {"spike_xyz", "map_radiance", "streak_map"})
            EXPECT_EQ(source.find(other), std::string::npos) << other;
    }
    EXPECT_GE(arcs, 1U);
}

}  // namespace
}  // namespace rowland::diffraction
