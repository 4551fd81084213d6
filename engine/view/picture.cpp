#include "engine/view/picture.h"

#include <utility>

#include "engine/gpu/lost_context.h"
#include "engine/post/shader_files.h"
#include "engine/post/working_space.h"

namespace rowland::view {

namespace {

constexpr int kSamples = 4;  ///< a pixel, against jagged edges

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
                     {.index = frame_++, .seconds = seconds, .luminance_weights = luminance_weights_},
                     targets_->encoded);
}

}  // namespace rowland::view
