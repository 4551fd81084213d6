#include "engine/post/post_stack.h"

#include <cmath>
#include <utility>

#include "engine/core/check.h"

namespace rowland::post {

namespace {

template <typename Pass>
Pass& made(std::optional<Pass>& pass, const gpu::ShaderLibrary& library) {
    if (!pass) pass.emplace(library);
    return *pass;
}

/// The pass rebuilt, if there was one.
template <typename Pass>
std::optional<Pass> rebuilt(const std::optional<Pass>& pass, const gpu::ShaderLibrary& library) {
    return pass ? std::optional<Pass>(std::in_place, library) : std::nullopt;
}

const gpu::Framebuffer& sized(std::optional<gpu::Framebuffer>& framebuffer, glm::ivec2 size, gpu::Format format) {
    if (!framebuffer || framebuffer->size() != size || framebuffer->colour().desc().format != format) {
        framebuffer.emplace(gpu::FramebufferDesc{.width = size.x, .height = size.y, .colours = {format}});
    }
    return *framebuffer;
}

}  // namespace

const gpu::Texture& PostStack::with_depth_of_field(const gpu::Texture& picture, const PostSettings& settings,
                                                   const PostFrame& frame) {
    if (!settings.depth_of_field) return picture;
    ROWLAND_CHECK(frame.depth != nullptr, "depth of field needs the frame's depth");
    const gpu::PassTimes::Scope scope(times_, "depth of field");
    const gpu::Framebuffer& focused = sized(focused_, picture.size(), picture.desc().format);
    made(depth_of_field_, *library_).draw(picture, *frame.depth, *settings.depth_of_field, frame.lens, focused);
    passes_ += DepthOfFieldPass::passes();
    return focused.colour();
}

const gpu::Texture& PostStack::with_glare(const gpu::Texture& picture, const PostSettings& settings) {
    if (!settings.glare || !has_effect(*settings.glare)) return picture;
    const gpu::PassTimes::Scope scope(times_, "glare");
    const gpu::Framebuffer& glared = sized(glared_, picture.size(), picture.desc().format);
    // This frame's automatic exposure is measured later, with glare.
    const float stops = settings.exposure_stops + automatic_stops_.value_or(0.0F);
    made(glare_, *library_).draw(picture, *settings.glare, settings.glare->threshold * std::exp2(-stops), glared);
    passes_ += GlarePass::passes();
    return glared.colour();
}

const gpu::Texture& PostStack::with_bloom(const gpu::Texture& picture, const PostSettings& settings) {
    if (!settings.bloom || settings.bloom->strength == 0.0F) return picture;
    const gpu::PassTimes::Scope scope(times_, "bloom");
    const gpu::Framebuffer& bloomed = sized(bloomed_, picture.size(), picture.desc().format);
    BloomPass& pass = made(bloom_, *library_);
    pass.draw(picture, *settings.bloom, bloomed);
    passes_ += pass.passes();
    return bloomed.colour();
}

float PostStack::automatic_stops(const gpu::Texture& picture, const PostSettings& settings, const PostFrame& frame) {
    if (!settings.auto_exposure) {
        forget_exposure();
        return 0.0F;
    }
    const AutoExposureSettings& automatic = *settings.auto_exposure;
    require_valid(automatic);
    ROWLAND_CHECK(frame.luminance_weights != glm::vec3(0.0F), "automatic exposure needs the frame's luminance_weights");
    const gpu::PassTimes::Scope scope(times_, "auto exposure");
    AutoExposurePass& pass = made(auto_exposure_, *library_);
    const bool waits = settings.wait_for_exposure || !automatic_stops_;
    // Taken before this frame's measurement starts, so that it is an earlier frame's, however fast the GPU is.
    std::optional<MeanLog2Luminance> measured = pass.take();
    pass.start(picture, frame.luminance_weights, automatic.darkest);
    passes_ += pass.passes();
    if (waits) measured = pass.wait();
    if (measured) {
        target_stops_.reset();
        if (*measured) target_stops_ = target_stops(**measured, automatic);
    }
    if (target_stops_)
        automatic_stops_ =
            adapted_stops(automatic_stops_.value_or(*target_stops_), *target_stops_, frame.seconds, automatic);
    return automatic_stops_.value_or(0.0F);
}

const gpu::Texture& PostStack::with_vignette(const gpu::Texture& picture, const PostSettings& settings) {
    if (!settings.vignette || !has_effect(*settings.vignette)) return picture;
    const gpu::PassTimes::Scope scope(times_, "vignette");
    const gpu::Framebuffer& vignetted = sized(vignetted_, picture.size(), picture.desc().format);
    made(vignette_, *library_).draw(picture, *settings.vignette, vignetted);
    ++passes_;
    return vignetted.colour();
}

void PostStack::draw_display(const gpu::Texture& picture, const DisplayPass& display, const PostSettings& settings,
                             const PostFrame& frame, const gpu::Framebuffer& target) {
    // Noise needs 16 fixed-point bits: half floats near 1 are no finer than an eighth of an 8-bit step.
    const bool noisy = settings.grain || settings.dither;
    const gpu::Framebuffer& displayed = noisy ? sized(displayed_, target.size(), gpu::Format::RGBA16) : target;
    {
        const gpu::PassTimes::Scope scope(times_, "display");
        display.draw(picture, exposure_stops_, displayed);
        ++passes_;
    }
    if (!noisy) return;
    const gpu::PassTimes::Scope scope(times_, "noise");
    made(noise_, *library_).draw(displayed.colour(), frame.index, settings.dither, settings.grain, target);
    ++passes_;
}

void PostStack::reload(const gpu::ShaderLibrary& library) {
    std::optional<DepthOfFieldPass> depth_of_field = rebuilt(depth_of_field_, library);
    std::optional<GlarePass> glare = rebuilt(glare_, library);
    std::optional<BloomPass> bloom = rebuilt(bloom_, library);
    std::optional<AutoExposurePass> auto_exposure = rebuilt(auto_exposure_, library);
    std::optional<VignettePass> vignette = rebuilt(vignette_, library);
    std::optional<NoisePass> noise = rebuilt(noise_, library);
    depth_of_field_ = std::move(depth_of_field);
    glare_ = std::move(glare);
    bloom_ = std::move(bloom);
    auto_exposure_ = std::move(auto_exposure);
    vignette_ = std::move(vignette);
    noise_ = std::move(noise);
    library_ = &library;
}

void PostStack::draw(const gpu::Texture& hdr, const DisplayPass& display, const PostSettings& settings,
                     const PostFrame& frame, const gpu::Framebuffer& target) {
    passes_ = 0;
    const gpu::Texture& focused = with_depth_of_field(hdr, settings, frame);
    const gpu::Texture& bloomed = with_bloom(with_glare(focused, settings), settings);
    exposure_stops_ = settings.exposure_stops + automatic_stops(bloomed, settings, frame);
    // Exposure and vignette are factors, so their order is free: the display pass exposes, at no extra cost.
    draw_display(with_vignette(bloomed, settings), display, settings, frame, target);
}

}  // namespace rowland::post
