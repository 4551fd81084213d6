#include "engine/post/display_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/error.h"

namespace OCIO = OCIO_NAMESPACE;

namespace rowland::post {

namespace {

constexpr float largest_half = 65504.0F;

/// Fills in the defaults and checks the names.
DisplaySelection resolve(const OcioConfig& config, DisplaySelection selection) {
    if (selection.display.empty()) selection.display = config.default_display();
    if (selection.view.empty()) selection.view = config.default_view(selection.display);
    config.require_view(selection.display, selection.view);
    return selection;
}

/// Replaces NaN and infinities, for which view transforms give different values in OpenColorIO's CPU and GPU code (an
/// infinite highlight comes out black, or as NaN).
glm::vec3 displayable(const glm::vec3& colour) {
    const auto component = [](float value) {
        return std::isnan(value) ? 0.0F : std::clamp(value, -largest_half, largest_half);
    };
    return {component(colour.r), component(colour.g), component(colour.b)};
}

OCIO::ConstProcessorRcPtr make_processor(const OcioConfig& config, const DisplaySelection& selection) {
    const OCIO::ExposureContrastTransformRcPtr exposure = OCIO::ExposureContrastTransform::Create();
    exposure->setStyle(OCIO::EXPOSURE_CONTRAST_LINEAR);
    exposure->makeExposureDynamic();

    const OCIO::DisplayViewTransformRcPtr display = OCIO::DisplayViewTransform::Create();
    display->setSrc(OCIO::ROLE_SCENE_LINEAR);
    display->setDisplay(selection.display.c_str());
    display->setView(selection.view.c_str());

    const OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    group->appendTransform(exposure);
    group->appendTransform(display);
    return config.ocio()->getProcessor(group);
}

}  // namespace

DisplayTransform::DisplayTransform(const OcioConfig& config, const DisplaySelection& selection)
    : selection_(resolve(config, selection)), config_source_(config.source()) {
    if (!config.ocio()->hasRole(OCIO::ROLE_SCENE_LINEAR)) {
        refuse_input(config.source(), "roles", "no scene_linear",
                     "the colour space light is computed in, as the role scene_linear",
                     "add the role to the configuration");
    }
    const ClassicLocale classic;
    try {
        processor_ = make_processor(config, selection_);
        cpu_ = processor_->getDefaultCPUProcessor();
    } catch (const OCIO::Exception& exception) {
        refuse_input(config.source(), fmt::format("display \"{}\", view \"{}\"", selection_.display, selection_.view),
                     exception.what(), "a view that can be built", "correct the configuration, or choose another view");
    }
}

void DisplayTransform::apply_cpu(std::span<glm::vec3> pixels, float exposure_stops) const {
    if (pixels.empty()) return;
    OCIO::DynamicPropertyRcPtr exposure = cpu_->getDynamicProperty(OCIO::DYNAMIC_PROPERTY_EXPOSURE);
    OCIO::DynamicPropertyValue::AsDouble(exposure)->setValue(static_cast<double>(exposure_stops));
    std::transform(pixels.begin(), pixels.end(), pixels.begin(), displayable);
    OCIO::PackedImageDesc image(&pixels.front().x, static_cast<long>(pixels.size()), 1, 3);
    cpu_->apply(image);
}

namespace {

constexpr const char* fragment_shader = "engine/post/shaders/display.frag.glsl";
constexpr unsigned first_lut_unit = 1;  // unit 0 is the picture

gpu::Sampling sampling_of(OCIO::Interpolation interpolation) {
    // The shader of a tetrahedral look-up interpolates between texels itself.
    const bool nearest = interpolation == OCIO::INTERP_NEAREST || interpolation == OCIO::INTERP_TETRAHEDRAL;
    return {.filter = nearest ? gpu::Filter::Nearest : gpu::Filter::Linear};
}

DisplayPass::Lut volume_lut(const OCIO::GpuShaderDescRcPtr& shader, unsigned index) {
    const char* texture_name = nullptr;
    const char* sampler_name = nullptr;
    unsigned edge = 0;
    OCIO::Interpolation interpolation = OCIO::INTERP_LINEAR;
    shader->get3DTexture(index, texture_name, sampler_name, edge, interpolation);
    const float* values = nullptr;
    shader->get3DTextureValues(index, values);
    const int size = static_cast<int>(edge);
    gpu::Texture texture(
        {.kind = gpu::TextureKind::Volume, .format = gpu::Format::RGB32F, .width = size, .height = size, .depth = size},
        sampling_of(interpolation));
    texture.upload(std::span<const float>(values, std::size_t{3} * edge * edge * edge), {.layers = size});
    return {sampler_name, std::move(texture)};
}

/// A one-dimensional table; OpenColorIO folds one that is too long for a texture line into rows.
DisplayPass::Lut line_lut(const OCIO::GpuShaderDescRcPtr& shader, unsigned index) {
    const char* texture_name = nullptr;
    const char* sampler_name = nullptr;
    unsigned width = 0;
    unsigned height = 0;
    OCIO::GpuShaderDesc::TextureType channel = OCIO::GpuShaderDesc::TEXTURE_RGB_CHANNEL;
    OCIO::Interpolation interpolation = OCIO::INTERP_LINEAR;
    shader->getTexture(index, texture_name, sampler_name, width, height, channel, interpolation);
    const float* values = nullptr;
    shader->getTextureValues(index, values);
    const bool is_red = channel == OCIO::GpuShaderDesc::TEXTURE_RED_CHANNEL;
    gpu::Texture texture({.kind = height > 1 ? gpu::TextureKind::Plane : gpu::TextureKind::Line,
                          .format = is_red ? gpu::Format::R32F : gpu::Format::RGB32F,
                          .width = static_cast<int>(width),
                          .height = static_cast<int>(height)},
                         sampling_of(interpolation));
    texture.upload(std::span<const float>(values, std::size_t{is_red ? 1U : 3U} * width * height));
    return {sampler_name, std::move(texture)};
}

}  // namespace

DisplayPass::DisplayPass(const gpu::ShaderLibrary& library, const DisplayTransform& transform) {
    set_transform(library, transform);
}

void DisplayPass::set_transform(const gpu::ShaderLibrary& library, const DisplayTransform& transform) {
    const ClassicLocale classic;
    OCIO::GpuShaderDescRcPtr shader = OCIO::GpuShaderDesc::CreateShaderDesc();
    shader->setLanguage(OCIO::GPU_LANGUAGE_GLSL_4_0);
    shader->setFunctionName("display_transform");
    shader->setResourcePrefix("ocio_");
    std::string cache_id;
    try {
        const OCIO::ConstGPUProcessorRcPtr processor = transform.processor()->getDefaultGPUProcessor();
        processor->extractGpuShaderInfo(shader);
        // The processor's id identifies the tables, the shader's the code.
        cache_id = fmt::format("{} {}", processor->getCacheID(), shader->getCacheID());
    } catch (const OCIO::Exception& exception) {
        refuse_input(transform.config_source(),
                     fmt::format("display \"{}\", view \"{}\"", transform.display(), transform.view()),
                     exception.what(), "a view that OpenColorIO can run on the GPU", "choose another view");
    }
    // A new description has its own dynamic properties even where the code is the same.
    shader_ = shader;
    if (cache_id_ == cache_id) return;
    build(library, fmt::format("{}, view \"{}\"", transform.config_source(), transform.view()));
    cache_id_ = cache_id;
}

void DisplayPass::build(const gpu::ShaderLibrary& library, const std::string& source) {
    gpu::ShaderText fragment = library.assemble(fragment_shader);
    fragment.text += gpu::line_directive(fragment.files.size(), 1) + shader_->getShaderText();
    fragment.files.push_back(source);
    program_ = gpu::Program(library.assemble(gpu::full_screen_vertex_shader), fragment);
    upload_luts();
}

void DisplayPass::upload_luts() {
    luts_.clear();
    for (unsigned i = 0; i < shader_->getNum3DTextures(); ++i) luts_.push_back(volume_lut(shader_, i));
    for (unsigned i = 0; i < shader_->getNumTextures(); ++i) luts_.push_back(line_lut(shader_, i));
    for (std::size_t i = 0; i < luts_.size(); ++i) program_.set(luts_[i].sampler, static_cast<int>(first_lut_unit + i));
}

void DisplayPass::set_uniforms() const {
    for (unsigned i = 0; i < shader_->getNumUniforms(); ++i) {
        OCIO::GpuShaderDesc::UniformData data;
        const char* name = shader_->getUniform(i, data);
        switch (data.m_type) {
            case OCIO::UNIFORM_DOUBLE:
                program_.set(name, static_cast<float>(data.m_getDouble()));
                break;
            case OCIO::UNIFORM_BOOL:
                program_.set(name, data.m_getBool() ? 1 : 0);
                break;
            case OCIO::UNIFORM_FLOAT3: {
                const OCIO::Float3& value = data.m_getFloat3();
                program_.set(name, glm::vec3(value[0], value[1], value[2]));
                break;
            }
            case OCIO::UNIFORM_VECTOR_FLOAT:
                program_.set(name, std::span<const float>(data.m_vectorFloat.m_getVector(),
                                                          static_cast<std::size_t>(data.m_vectorFloat.m_getSize())));
                break;
            case OCIO::UNIFORM_VECTOR_INT:
                program_.set(name, std::span<const int>(data.m_vectorInt.m_getVector(),
                                                        static_cast<std::size_t>(data.m_vectorInt.m_getSize())));
                break;
            case OCIO::UNIFORM_UNKNOWN:
                ROWLAND_CHECK(false, "an OpenColorIO uniform of unknown type");
        }
    }
}

void DisplayPass::draw(const gpu::Texture& source, float exposure_stops, const gpu::Framebuffer& target) const {
    OCIO::DynamicPropertyRcPtr exposure = shader_->getDynamicProperty(OCIO::DYNAMIC_PROPERTY_EXPOSURE);
    OCIO::DynamicPropertyValue::AsDouble(exposure)->setValue(static_cast<double>(exposure_stops));
    set_uniforms();
    source.bind(0);
    for (std::size_t i = 0; i < luts_.size(); ++i) luts_[i].texture.bind(first_lut_unit + static_cast<unsigned>(i));
    triangle_.draw(program_, target);
}

}  // namespace rowland::post
