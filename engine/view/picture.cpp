#include "engine/view/picture.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/context.h"
#include "engine/image/byte_image.h"
#include "engine/image/exr.h"
#include "engine/post/ocio_config.h"
#include "engine/post/post_stack.h"

namespace rowland::view {

namespace {

void require_finite(const std::vector<glm::vec4>& pixels, int width, const std::filesystem::path& path) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::vec4& pixel = pixels[i];
        if (std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b)) continue;
        const std::size_t columns = static_cast<std::size_t>(width);
        throw Error({.file = path.string(),
                     .location = fmt::format("column {}, row {}", i % columns, i / columns),
                     .found = fmt::format("({}, {}, {})", pixel.r, pixel.g, pixel.b),
                     .expected = "finite radiance",
                     .remedy = "nothing was written; please report the scene",
                     .fault = Fault::System});
    }
}

}  // namespace

std::filesystem::path numbered(const std::filesystem::path& path, int frame, int frames) {
    if (frames == 1) return path;
    std::filesystem::path result = path.parent_path() / path.stem();
    result += fmt::format("_{:04}", frame);
    result += path.extension();
    return result;
}

void write_display_capture(const gpu::Framebuffer& display, const std::filesystem::path& path) {
    const std::vector<std::uint8_t> rgba = display.read_rgba8();
    gpu::require_context();
    std::vector<std::uint8_t> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    image::write_png(path, display.size().x, display.size().y, rgb);
    log_info("wrote {}", path.string());
}

void write_linear_capture(const gpu::Framebuffer& linear, const std::filesystem::path& path) {
    const std::vector<glm::vec4> pixels = linear.read_rgba_float();
    gpu::require_context();
    require_finite(pixels, linear.size().x, path);
    const image::Image picture{
        .width = linear.size().x, .height = linear.size().y, .texels = {pixels.begin(), pixels.end()}};
    image::write_exr(path, picture);
    log_info("wrote {}", path.string());
}

namespace {

constexpr int kSamples = 4;  ///< per pixel, against aliasing

std::unique_ptr<gpu::ShaderLibrary> make_post_shaders() {
    auto library = std::make_unique<gpu::ShaderLibrary>();
    library->add_embedded(post::shader_files());
    return library;
}

post::DisplayTransform make_transform(const post::OcioConfig& config, const std::string& view) {
    return post::DisplayTransform(config, {.display = {}, .view = view});
}

}  // namespace

Picture::Picture(const post::OcioConfig& config, const std::string& view, glm::ivec2 size)
    : xyz_to_working_(post::xyz_to_scene_linear(config)),
      luminance_weights_(post::luminance_weights(config)),
      renderer_(xyz_to_working_),
      post_shaders_(make_post_shaders()),
      transform_(make_transform(config, view)),
      display_(*post_shaders_, transform_),
      post_stack_(*post_shaders_) {
    renderer_.use_key_lights(true);
    resize(size);
}

void Picture::set_probe(const lighting::LightProbe& probe) {
    renderer_.set_probe(probe);
    post_stack_.forget_exposure();
}

void Picture::time_passes(bool on) {
    timed_ = on;
    renderer_.set_pass_times(on ? &pass_times_ : nullptr);
    post_stack_.set_pass_times(on ? &pass_times_ : nullptr);
}

void Picture::set_view(const post::OcioConfig& config, const std::string& view) {
    transform_ = make_transform(config, view);
    display_.set_transform(*post_shaders_, transform_);
}

void Picture::reload_shaders(const std::filesystem::path& source_tree) {
    auto post_shaders = std::make_unique<gpu::ShaderLibrary>(*post_shaders_);
    post_shaders->set_source_folder(source_tree);
    post::DisplayPass display(*post_shaders, transform_);
    renderer_.reload_shaders(source_tree);
    post_stack_.reload(*post_shaders);
    display_ = std::move(display);
    post_shaders_ = std::move(post_shaders);
}

std::vector<std::filesystem::path> Picture::shader_sources(const std::filesystem::path& source_tree) const {
    std::vector<std::filesystem::path> files;
    for (const gpu::ShaderLibrary* library : {&renderer_.shaders(), &std::as_const(*post_shaders_)})
        for (const std::string& name : library->names()) files.push_back(source_tree / name);
    return files;
}

void Picture::resize(glm::ivec2 size) {
    if (targets_ && targets_->linear.size() == size) return;
    targets_.emplace(Targets{gpu::Framebuffer({.width = size.x, .height = size.y, .depth = true, .samples = kSamples}),
                             gpu::Framebuffer({.width = size.x, .height = size.y}),
                             gpu::Framebuffer({.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA8}})});
}

/// The frame's depth with one sample per pixel; null unless depth of field needs it.
const gpu::Texture* Picture::resolved_depth() {
    if (!post_settings_.depth_of_field) return nullptr;
    std::optional<gpu::Framebuffer>& depth = targets_->depth;
    if (!depth)
        depth.emplace(gpu::FramebufferDesc{
            .width = targets_->linear.size().x, .height = targets_->linear.size().y, .colours = {}, .depth = true});
    targets_->multisampled.resolve_depth_to(*depth);
    return &depth->depth();
}

void Picture::draw(ecs::World& world, const scene::Camera& camera, float seconds) {
    gpu::require_context();
    if (timed_) pass_times_.begin_frame();
    renderer_.render(world, camera, targets_->multisampled);
    {
        const gpu::PassTimes::Scope scope(timed_ ? &pass_times_ : nullptr, "resolve");
        targets_->multisampled.resolve_to(targets_->linear);
    }
    if (post_settings_.glare) post_settings_.glare->vertical_fov = camera.vertical_field_of_view;
    if (post_settings_.vignette) post_settings_.vignette->vertical_fov = camera.vertical_field_of_view;
    post_stack_.draw(targets_->linear.colour(), display_, post_settings_,
                     {.index = frame_++,
                      .seconds = seconds,
                      .luminance_weights = luminance_weights_,
                      .depth = resolved_depth(),
                      .lens = {.vertical_fov = camera.vertical_field_of_view,
                               .near_plane = camera.near_plane,
                               .far_plane = camera.far_plane,
                               .target_m = glm::length(camera.target - camera.eye)}},
                     targets_->encoded);
}

}  // namespace rowland::view
