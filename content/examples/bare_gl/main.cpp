// bare_gl MATERIAL PROBE PICTURE: a disc with the cooked material MATERIAL under the light probe PROBE (.hdr or .exr,
// equirectangular) and a lamp, drawn with Rowland's shaders and without its renderer. Writes a PNG, and to standard
// output the directions and the radiance of a few pixels. modules/diffraction/PORTING.md explains the steps.
#include <engine/image/byte_image.h>
#include <engine/image/image.h>
#include <engine/lighting/light_samples.h>
#include <modules/diffraction/asset/cooked_material.h>
#include <modules/diffraction/bake/kernel_cells.h>
#include <modules/diffraction/representations/planar/planar_map.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "context.h"
#include "program.h"

using namespace rowland;

namespace {

constexpr int kSize = 768;                     // of the picture, in pixels
constexpr int kEvery = 48;                     // distance between printed pixels, in pixels
const glm::vec3 kEye(0.0F, 0.11F, 0.17F);      // metres
const glm::vec3 kLamp(-0.36F, 0.80F, -0.48F);  // toward it
const glm::vec3 kLampFlux(0.06F);              // RGB radiance times solid angle
constexpr float kLampRadius = 0.01F;           // radians
const glm::mat4 kDisc = glm::rotate(glm::mat4(1.0F), glm::radians(12.0F), glm::vec3(1.0F, 0.0F, 0.0F));
const glm::vec3 kNormal = glm::vec3(kDisc[1]);  // the disc lies in its own xz plane

// Bakes what the lamp needs, and binds it.
void bind_kernel(GLuint program, const diffraction::CookedMaterial& material) {
    const double pitch_nm = material.material.grating.pitch_nm;
    const diffraction::BlurredKernel kernel = diffraction::blur_for_lights(material.kernel, pitch_nm);
    const int views = kernel.views;  // more than 1: the texture is a volume with this many slices for each layer
    GLuint texture = 0;
    glCreateTextures(views > 1 ? GL_TEXTURE_3D : GL_TEXTURE_2D_ARRAY, 1, &texture);
    glTextureStorage3D(texture, 1, GL_RGB32F, kernel.columns, kernel.levels, 3 * views);
    for (int colour = 0; colour < 3; ++colour) {  // a layer each for red, green and blue light
        std::vector<glm::vec3> xyz;
        for (const glm::mat3& value : kernel.values) xyz.push_back(value[colour]);
        glTextureSubImage3D(texture, 0, 0, 0, colour * views, kernel.columns, kernel.levels, views, GL_RGB, GL_FLOAT,
                            xyz.data());
    }
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTextureUnit(10, texture);

    const auto uniforms = diffraction::kernel_uniforms(material.kernel, kernel);
    glProgramUniform4fv(program, glGetUniformLocation(program, "kernel_scale_bias"), 1,
                        glm::value_ptr(uniforms.scale_bias));
    glProgramUniform2fv(program, glGetUniformLocation(program, "kernel_rows"), 1, glm::value_ptr(uniforms.rows));
    glProgramUniform2fv(program, glGetUniformLocation(program, "kernel_reach"), 1, glm::value_ptr(uniforms.reach));
    glProgramUniform3fv(program, glGetUniformLocation(program, "kernel_views"), 1,
                        glm::value_ptr(diffraction::kernel_views(kernel, 3)));
}

// Bakes what the probe needs, and binds it: again whenever the probe, or the plane's normal, changes.
void bind_map(GLuint program, const diffraction::CookedMaterial& material, const char* probe_file) {
    const lighting::ProbeImage probe(image::load_image(probe_file), lighting::Mapping::Equirectangular, probe_file);
    const diffraction::PlanarMap map = diffraction::fill_planar_map(
        lighting::light_samples(probe), material.kernel, material.material.grating.pitch_nm, glm::dvec3(kNormal),
        {.azimuths = 256, .views = 256}, material.zero_order_xyz);
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGB32F, map.azimuths, map.views);
    glTextureSubImage2D(texture, 0, 0, 0, map.azimuths, map.views, GL_RGB, GL_FLOAT, map.xyz.data());
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTextureUnit(11, texture);

    const auto set = [&](const char* name, const glm::vec3& value) {
        glProgramUniform3fv(program, glGetUniformLocation(program, name), 1, glm::value_ptr(value));
    };
    set("planar_e1", glm::vec3(map.e1));
    set("planar_e2", glm::vec3(map.e2));
    glProgramUniform2f(program, glGetUniformLocation(program, "planar_map_half_texel"), 0.5F / 256, 0.5F / 256);
    glProgramUniform1f(program, glGetUniformLocation(program, "map_scale"), 1.0F);
}

void set_scene(GLuint program) {
    const glm::mat4 clip = glm::perspective(glm::radians(33.0F), 1.0F, 0.01F, 1.0F) *
                           glm::lookAt(kEye, glm::vec3(0.0F), glm::vec3(0.0F, 1.0F, 0.0F));
    const auto at = [&](const char* name) { return glGetUniformLocation(program, name); };
    glProgramUniformMatrix4fv(program, at("world_to_clip"), 1, GL_FALSE, glm::value_ptr(clip));
    glProgramUniformMatrix4fv(program, at("disc_to_world"), 1, GL_FALSE, glm::value_ptr(kDisc));
    glProgramUniform3fv(program, at("eye"), 1, glm::value_ptr(kEye));
    glProgramUniform3fv(program, at("normal"), 1, glm::value_ptr(kNormal));
    glProgramUniform3fv(program, at("lamp_direction"), 1, glm::value_ptr(kLamp));
    glProgramUniform3fv(program, at("lamp_flux"), 1, glm::value_ptr(kLampFlux));
    glProgramUniform1f(program, at("lamp_radius"), kLampRadius);
    glProgramUniform1f(program, at("exposure"), 2.0F);
}

// Draws into a framebuffer of four colours: the picture, and numbers.
void draw(GLuint program) {
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    std::array<GLuint, 4> colours{};
    glCreateTextures(GL_TEXTURE_2D, 4, colours.data());
    std::array<GLenum, 4> buffers{};
    for (unsigned i = 0; i < 4; ++i) {
        glTextureStorage2D(colours[i], 1, i == 0 ? GL_RGBA8 : GL_RGBA32F, kSize, kSize);
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0 + i, colours[i], 0);
        buffers[i] = GL_COLOR_ATTACHMENT0 + i;
    }
    glNamedFramebufferDrawBuffers(framebuffer, 4, buffers.data());
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, kSize, kSize);
    glClear(GL_COLOR_BUFFER_BIT);
    GLuint vertices = 0;  // OpenGL needs one, even empty
    glCreateVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glUseProgram(program);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 2 * 251);
}

std::vector<glm::vec4> read_numbers(GLenum buffer) {
    std::vector<glm::vec4> texels(std::size_t{kSize} * kSize);
    glReadBuffer(buffer);
    glReadPixels(0, 0, kSize, kSize, GL_RGBA, GL_FLOAT, texels.data());
    return texels;
}

void print_pixels() {
    const auto probe = read_numbers(GL_COLOR_ATTACHMENT1);
    const auto lamp = read_numbers(GL_COLOR_ATTACHMENT2);
    const auto world_point = read_numbers(GL_COLOR_ATTACHMENT3);
    std::puts("vx,vy,vz,nx,ny,nz,gx,gy,gz,footprint,probe_X,probe_Y,probe_Z,lamp_X,lamp_Y,lamp_Z");
    for (int pixel = 0; pixel < kSize * kSize; ++pixel) {
        const auto i = static_cast<std::size_t>(pixel);
        if (pixel % kEvery != 0 || pixel / kSize % kEvery != 0 || probe[i].w == 0.0F) continue;  // 0: not the disc
        const glm::vec3 position(world_point[i]);
        for (const glm::vec3& vector : {glm::normalize(kEye - position), kNormal, glm::normalize(position)})
            std::printf("%.9g,%.9g,%.9g,", vector.x, vector.y, vector.z);
        std::printf("%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", world_point[i].w, probe[i].x, probe[i].y, probe[i].z,
                    lamp[i].x, lamp[i].y, lamp[i].z);
    }
}

void write_picture(const char* file) {
    constexpr std::size_t row = 3 * kSize;
    std::vector<std::uint8_t> upside_down(row * kSize), picture;
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, kSize, kSize, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
    for (auto end = upside_down.end(); end != upside_down.begin(); end -= row)
        picture.insert(picture.end(), end - row, end);
    image::write_png(file, kSize, kSize, picture);
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 4) return std::fprintf(stderr, "usage: bare_gl MATERIAL PROBE PICTURE\n"), 2;
    make_headless_context();
    const diffraction::CookedMaterial material = diffraction::load_cooked_material(argv[1]);
    const std::string from =
        std::string("#version 450 core\n") + (material.kernel.views > 1 ? "#define KERNEL_VIEWS\n" : "");
    const std::string rowland = ROWLAND_SHADERS "/";
    const std::string module = rowland + "modules/diffraction/";
    const GLuint program =
        make_program({from, read_text(EXAMPLE_SHADERS "/disc.vert.glsl")},
                     {from, read_text(rowland + "engine/gpu/shaders/dialect.glsl"),
                      read_text(module + "representations/planar/planar_map.glsl"),
                      read_text(module + "shaders/kernel.glsl"), read_text(EXAMPLE_SHADERS "/disc.frag.glsl")});

    bind_kernel(program, material);
    bind_map(program, material, argv[2]);
    set_scene(program);
    draw(program);
    print_pixels();
    write_picture(argv[3]);
    return 0;
} catch (const std::exception& error) {
    return std::fprintf(stderr, "error: %s\n", error.what()), 2;
}
