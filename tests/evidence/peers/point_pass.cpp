#include "tests/evidence/peers/point_pass.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "engine/colour/colour_space.h"
#include "engine/gpu/context.h"

namespace rowland::evidence {

namespace {

constexpr int kColumns = 128;

/// A texel per point: a row of the tangent frame, or the view if `row` is -1.
gpu::Texture texture_of(std::span<const diffraction::ShadingPoint> points, int height, int row) {
    std::vector<glm::vec4> texels(static_cast<std::size_t>(kColumns * height), glm::vec4(0.0F));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dmat3 axes = glm::transpose(world_to_tangent(points[i]));
        texels[i] = glm::vec4(row < 0 ? glm::normalize(points[i].view) : axes[row], 0.0);
    }
    gpu::Texture texture({.format = gpu::Format::RGBA32F, .width = kColumns, .height = height},
                         {.filter = gpu::Filter::Nearest});
    texture.upload(std::span<const glm::vec4>(texels));
    return texture;
}

int rows_of(std::size_t count) {
    return std::max(1, (static_cast<int>(count) + kColumns - 1) / kColumns);
}

}  // namespace

PointPass::PointPass(std::span<const diffraction::ShadingPoint> points)
    : count_(points.size()),
      views_(texture_of(points, rows_of(count_), -1)),
      normals_(texture_of(points, rows_of(count_), 2)),
      gratings_(texture_of(points, rows_of(count_), 0)),
      target_({.width = kColumns, .height = rows_of(count_), .colours = {gpu::Format::RGBA32F}}) {
    add_peer_shaders(library_);
}

const gpu::Program& PointPass::program(const PeerSetting& setting) {
    const std::pair key(std::string(setting.peer->name), setting.orders);
    const auto found = programs_.find(key);
    if (found != programs_.end()) return found->second;
    std::vector<gpu::Define> defines{peer_define(*setting.peer)};
    if (setting.orders > 0) defines.emplace_back("PEER_ORDERS", std::to_string(setting.orders));
    const gpu::ProgramDesc desc =
        gpu::full_screen_pass("tests/evidence/peers/point_pass.frag.glsl", std::move(defines));
    return programs_.emplace(key, gpu::Program(library_, desc)).first->second;
}

std::vector<glm::dvec3> PointPass::draw(const PeerSetting& setting, std::span<const render::DistantLight> lights) {
    const gpu::Program& drawn = program(setting);
    const gpu::Buffer buffer = light_buffer(lights);
    drawn.set("peer_parameters", setting.parameters);
    drawn.set("peer_highlight", setting.highlight ? 1.0F : 0.0F);
    views_.bind(0);
    normals_.bind(1);
    gratings_.bind(2);
    buffer.bind_storage(kPeerLightBinding);
    triangle_.draw(drawn, target_);
    const std::vector<glm::vec4> pixels = target_.read_rgba_float();  // from the top row down
    gpu::require_context();
    const auto columns = static_cast<std::size_t>(kColumns);
    const std::size_t rows = pixels.size() / columns;
    std::vector<glm::dvec3> rgb;
    for (std::size_t i = 0; i < count_; ++i) rgb.emplace_back(pixels[(rows - 1 - i / columns) * columns + i % columns]);
    return rgb;
}

std::vector<glm::dvec3> xyz_of(std::span<const glm::dvec3> rgb) {
    const glm::dmat3 matrix = colour::rec709_to_xyz();
    std::vector<glm::dvec3> xyz;
    for (const glm::dvec3& value : rgb) xyz.push_back(matrix * value);
    return xyz;
}

}  // namespace rowland::evidence
