#include "engine/gpu/framebuffer.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/gpu/context.h"
#include "engine/gpu/pipeline_state.h"

namespace rowland::gpu {

namespace {

/// Binds for draws and reads; only Framebuffer::read() binds another one for reads.
void bind_framebuffer(GLuint name) {
    if (bound_state().changes(BoundState::Slot::Framebuffer, 0, {name})) glBindFramebuffer(GL_FRAMEBUFFER, name);
}

GLuint create_framebuffer() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return name;
}

/// Reverses the order of rows.
template <typename T>
void flip_rows(std::vector<T>& values, int height) {
    const std::size_t row = values.size() / static_cast<std::size_t>(height);
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(height) - 1; top < bottom; ++top, --bottom) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(top * row);
        std::swap_ranges(begin, begin + static_cast<std::ptrdiff_t>(row),
                         values.begin() + static_cast<std::ptrdiff_t>(bottom * row));
    }
}

}  // namespace

void Framebuffer::Release::operator()(GLuint name) const {
    glDeleteFramebuffers(1, &name);
    bound_state().forget(BoundState::Slot::Framebuffer, name);
}

void Framebuffer::ReleaseRenderbuffer::operator()(GLuint name) const {
    glDeleteRenderbuffers(1, &name);
}

Framebuffer::Framebuffer(const FramebufferDesc& desc)
    : handle_(create_framebuffer()),
      size_(desc.width, desc.height),
      holds_halves_(!desc.colours.empty() && is_half_float(desc.colours.front())),
      colour_count_(desc.colours.size()) {
    ROWLAND_CHECK_OP(desc.samples, >=, 1);
    std::vector<GLenum> draw_buffers;
    for (const Format format : desc.colours) {
        draw_buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(draw_buffers.size()));
        attach(draw_buffers.back(), format, desc, colours_);
    }
    if (desc.depth) attach(GL_DEPTH_ATTACHMENT, Format::Depth32F, desc, depth_);
    glNamedFramebufferDrawBuffers(id(), static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    require_complete();
}

void Framebuffer::attach(GLenum attachment, Format format, const FramebufferDesc& desc,
                         std::vector<Texture>& textures) {
    if (desc.samples == 1) {
        textures.emplace_back(TextureDesc{.format = format, .width = desc.width, .height = desc.height},
                              attachment == GL_DEPTH_ATTACHMENT ? desc.depth_sampling : Sampling{});
        glNamedFramebufferTexture(id(), attachment, textures.back().id(), 0);
        return;
    }
    require_texture({.format = format, .width = desc.width, .height = desc.height}, read_limits());
    GLuint name = 0;
    glCreateRenderbuffers(1, &name);
    multisampled_.emplace_back(name);
    glNamedRenderbufferStorageMultisample(name, desc.samples, internal_format(format), desc.width, desc.height);
    glNamedFramebufferRenderbuffer(id(), attachment, GL_RENDERBUFFER, name);
}

Framebuffer Framebuffer::onto(const Texture& texture, int level, int layer) {
    Framebuffer result;
    result.handle_ = Handle<Release>(create_framebuffer());
    result.size_ = texture.size(level);
    result.holds_halves_ = is_half_float(texture.desc().format);
    const TextureKind kind = texture.desc().kind;
    if (kind == TextureKind::Line || kind == TextureKind::Plane) {
        glNamedFramebufferTexture(result.id(), GL_COLOR_ATTACHMENT0, texture.id(), level);
    } else {
        glNamedFramebufferTextureLayer(result.id(), GL_COLOR_ATTACHMENT0, texture.id(), level, layer);
    }
    result.require_complete();
    return result;
}

void Framebuffer::require_complete() const {
    const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    throw Error({.file = "framebuffer",
                 .location = fmt::format("{}x{}", size_.x, size_.y),
                 .found = fmt::format("a combination of formats the driver refuses (status {:#x})", status),
                 .expected = "colour formats that can be drawn into",
                 .remedy = {},
                 .fault = Fault::System});
}

void Framebuffer::resolve_to(const Framebuffer& target) const {
    ROWLAND_CHECK(size_ == target.size_, "a resolve between framebuffers of different size");
    ROWLAND_CHECK_OP(colour_count_, ==, target.colour_count_);
    const auto resolve = [&] {
        glBlitNamedFramebuffer(id(), target.id(), 0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y, GL_COLOR_BUFFER_BIT,
                               GL_NEAREST);
    };
    if (colour_count_ == 1) return resolve();
    std::vector<GLenum> draw_buffers;
    for (std::size_t i = 0; i < colour_count_; ++i) {
        draw_buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        glNamedFramebufferReadBuffer(id(), draw_buffers.back());
        glNamedFramebufferDrawBuffer(target.id(), draw_buffers.back());
        resolve();
    }
    // Draws into the target go to all its colours again.
    glNamedFramebufferDrawBuffers(target.id(), static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    glNamedFramebufferReadBuffer(id(), GL_COLOR_ATTACHMENT0);
}

void Framebuffer::resolve_depth_to(const Framebuffer& target) const {
    ROWLAND_CHECK(size_ == target.size_, "a resolve between framebuffers of different size");
    glBlitNamedFramebuffer(id(), target.id(), 0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y, GL_DEPTH_BUFFER_BIT,
                           GL_NEAREST);
}

void Framebuffer::show_in_window() const {
    bind_framebuffer(0);
    // Mesa's software renderer asks for a window's size when a viewport is set while its framebuffer is bound.
    bound_state().changes(BoundState::Slot::Viewport, 0, {size_.x, size_.y});
    glViewport(0, 0, size_.x, size_.y);
    glBlitNamedFramebuffer(id(), 0, 0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::bind() const {
    bind_framebuffer(id());
    if (bound_state().changes(BoundState::Slot::Viewport, 0, {size_.x, size_.y})) glViewport(0, 0, size_.x, size_.y);
}

void Framebuffer::bind_window() {
    bind_framebuffer(0);
}

void Framebuffer::clear(const glm::vec4& colour, unsigned attachment) const {
    const std::array<float, 4> value{colour.r, colour.g, colour.b, colour.a};
    glClearNamedFramebufferfv(id(), GL_COLOR, static_cast<GLint>(attachment), value.data());
}

void Framebuffer::clear_depth(float depth) const {
    set_depth_write(true);
    glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &depth);
}

const Texture& Framebuffer::colour(unsigned attachment) const {
    ROWLAND_CHECK_OP(attachment, <, colours_.size());
    return colours_[attachment];
}

const Texture& Framebuffer::depth() const {
    ROWLAND_CHECK(!depth_.empty(), "the framebuffer has no depth texture");
    return depth_[0];
}

void Framebuffer::read(unsigned attachment, GLenum type, void* pixels) const {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glNamedFramebufferReadBuffer(id(), GL_COLOR_ATTACHMENT0 + attachment);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
    // By default reading from a fixed-point buffer clamps, reading floats does not.
    glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, type, pixels);
    glNamedFramebufferReadBuffer(id(), GL_COLOR_ATTACHMENT0);
}

std::vector<glm::vec4> Framebuffer::read_rgba_float(unsigned attachment) const {
    std::vector<glm::vec4> pixels(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y));
    read(attachment, GL_FLOAT, pixels.data());
    flip_rows(pixels, size_.y);
    return pixels;
}

std::vector<std::uint8_t> Framebuffer::read_rgba8(unsigned attachment) const {
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y));
    read(attachment, GL_UNSIGNED_BYTE, pixels.data());
    flip_rows(pixels, size_.y);
    return pixels;
}

void FullScreenTriangle::draw(const Program& program, const Framebuffer& target) const {
    target.bind();
    draw(program);
}

void FullScreenTriangle::draw(const Program& program) const {
    apply(PipelineState{.depth_test = DepthTest::Off, .depth_write = false, .cull = Cull::None, .blend = Blend::Off});
    program.use();
    vertices_.draw(3);
}

}  // namespace rowland::gpu
