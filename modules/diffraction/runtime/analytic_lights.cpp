#include "modules/diffraction/runtime/analytic_lights.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/colour/colour_space.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/representations/direct/lobe_table.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/key_lobe.h"

namespace rowland::diffraction {

namespace {

glm::dmat3 xyz_to_kernel(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working) {
    return depends_on_wavelength(cooked.material.grating.lobe) ? glm::dmat3(1.0) : xyz_to_working;
}

/// Number of probes whose key lights' tables are kept.
constexpr std::size_t kKeptLobes = 16;

/// The first of `kept` that is `wanted`, else a new one by `make`, moved to the front. A new one may replace the least
/// recently used.
template <typename Lobes, typename Wanted, typename Make>
const Lobes& last_used(std::vector<Lobes>& kept, const Wanted& wanted, const Make& make) {
    auto found = std::ranges::find_if(kept, wanted);
    if (found == kept.end()) {
        if (kept.size() == kKeptLobes) kept.pop_back();
        kept.push_back(make());
        found = kept.end() - 1;
    }
    std::rotate(kept.begin(), found, found + 1);
    return kept.front();
}

}  // namespace

GpuKernel::GpuKernel(std::shared_ptr<const CookedMaterial> cooked, const glm::dmat3& xyz_to_working)
    : cooked_(std::move(cooked)),
      xyz_to_kernel_(xyz_to_kernel(*cooked_, xyz_to_working)),
      zero_order_(xyz_to_kernel_ * cooked_->zero_order_xyz),
      working_to_rec709_(glm::inverse(xyz_to_working * colour::rec709_to_xyz())),
      layout_(layout_for_lights(cooked_->kernel, cooked_->material.grating.pitch_nm)),
      uniforms_(kernel_uniforms(cooked_->kernel, layout_)) {}

BlurredKernel GpuKernel::blurred() const {
    return blur(in_space(cooked_->kernel, xyz_to_kernel_), layout_);
}

GpuKernel::Smoothed GpuKernel::smooth(std::span<const glm::vec3> light_colours, bool key_windows) const {
    // fp16 adds an error of 5e-4. With several views, that of the texture unit's 8-bit weights is larger.
    const bool volume = layout_.views > 1;
    // Red, green and blue of all views take as much as 30 MB, and key lights' windows alone read them.
    const int first = volume && !key_windows ? kFirstColourLayer : 0;
    std::vector<glm::vec3> layers;
    for (int c = first; c < kFirstColourLayer; ++c) layers.push_back(glm::mat3(1.0F)[c]);
    layers.insert(layers.end(), light_colours.begin(), light_colours.end());
    if (layers.empty()) layers.emplace_back(0.0F);
    Smoothed smoothed{.texture = gpu::Texture({.kind = volume ? gpu::TextureKind::Volume : gpu::TextureKind::PlaneArray,
                                               .format = volume ? gpu::Format::RGBA16F : gpu::Format::RGBA32F,
                                               .width = layout_.columns,
                                               .height = layout_.levels,
                                               .depth = static_cast<int>(layers.size()) * layout_.views},
                                              {.filter = gpu::Filter::Linear}),
                      .first_layer = first,
                      .colours{light_colours.begin(), light_colours.end()}};
    std::optional<BlurredKernel> made;
    const BlurredKernel& kernel = blurred_ ? *blurred_ : made.emplace(blurred());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        std::vector<glm::vec4> texels;
        texels.reserve(kernel.values.size());
        for (const glm::mat3& value : kernel.values) texels.emplace_back(value * layers[i], 0.0F);
        smoothed.texture.upload(std::span<const glm::vec4>(texels),
                                {.layer = static_cast<int>(i) * layout_.views, .layers = layout_.views});
    }
    return smoothed;
}

void GpuKernel::add_defines(gpu::ProgramDesc& desc) const {
    if (cooked_->kernel.views > 1) desc.defines.push_back({"KERNEL_VIEWS", "1"});
    const GrooveLobe& lobe = cooked_->material.grating.lobe;
    if (has_zero_order()) desc.defines.push_back({"ZERO_ORDER", "1"});
    if (std::holds_alternative<GaussianLobe>(lobe)) desc.defines.push_back({"LOBE_GAUSSIAN", "1"});
    if (std::holds_alternative<PitsLobe>(lobe)) desc.defines.push_back({"LOBE_PITS", "1"});
    if (std::holds_alternative<PitSequenceLobe>(lobe))
        desc.defines.push_back({"LOBE_PIT_SEQUENCE", std::to_string(kMostPitSpacings)});
}

void GpuKernel::set_lobe(const gpu::Program& program) const {
    const GrooveLobe& lobe = cooked_->material.grating.lobe;
    const auto set_gaussian = [&](double sigma, double power) {
        program.set("lobe_gaussian",
                    glm::vec2(glm::dvec2(sigma, power * lobe_density(GaussianLobe{sigma}, 0.0, 550.0))));
    };
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) set_gaussian(gaussian->sigma, 1.0);
    if (const auto* pits = std::get_if<PitsLobe>(&lobe)) {
        set_gaussian(kCoherentSigma, pits->coherent);
        program.set("pit_length_over_wavelength", glm::vec3(pits->length_nm / kPitsWavelengths_nm));
        program.set("incoherent", static_cast<float>(1.0 - pits->coherent));
    }
    if (const auto* sequence = std::get_if<PitSequenceLobe>(&lobe)) {
        set_gaussian(sequence->sigma, 1.0);
        const auto count = static_cast<double>(sequence->spacings_nm.size());
        const double of_first_order = (1.0 - sequence->coherent) / count * pit_order_power(1);
        program.set("pit_powers", glm::vec2(glm::dvec2(sequence->coherent, of_first_order)));
        std::vector<glm::vec4> spacings;
        for (const double spacing_nm : sequence->spacings_nm)
            spacings.emplace_back(glm::dvec4(spacing_nm / kPitsWavelengths_nm, 0.0));
        program.set("pit_spacing_count", static_cast<int>(spacings.size()));
        program.set("pit_spacings", std::span<const glm::vec4>(spacings));
    }
}

void GpuKernel::bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
                     std::span<const glm::vec3> light_colours, bool key_windows) const {
    const double pitch_nm = cooked_->material.grating.pitch_nm;
    const auto keep_blurred = [&] {
        if (!blurred_) blurred_ = blurred();
    };
    const auto make_lobes = [&] {
        keep_blurred();
        return GpuLobes(*blurred_, key_lights);
    };
    if (program.has_uniform("lobe_scale_bias") && !key_lights.empty())
        last_used(
            lobes_, [&](const GpuLobes& lobes) { return lobes.are_of(key_lights); }, make_lobes)
            .bind(program, uniforms_, pitch_nm);
    set_lobe(program);
    if (!program.has_uniform("kernel_scale_bias")) return;
    const bool has_primaries = smoothed_ && smoothed_->first_layer == 0;
    if (!smoothed_ || !std::ranges::equal(smoothed_->colours, light_colours) || (key_windows && !has_primaries)) {
        if (smoothed_) keep_blurred();  // colours that change once may change in every frame
        smoothed_ = smooth(light_colours, key_windows || has_primaries);
    }
    smoothed_->texture.bind(kKernelUnit);
    program.set("kernel_scale_bias", uniforms_.scale_bias);
    program.set("kernel_rows", uniforms_.rows);
    program.set("kernel_reach", uniforms_.reach);
    const int layers = smoothed_->texture.desc().depth / layout_.views;
    program.set("kernel_views", kernel_views(layout_, static_cast<std::size_t>(layers),
                                             static_cast<std::size_t>(smoothed_->first_layer)));
    program.set("zero_order", zero_order_);
    program.set("working_to_rec709", working_to_rec709_);
}

GpuLobes::GpuLobes(const BlurredKernel& kernel, std::span<const lighting::KeyLight> lights)
    : lights_(lights.begin(), lights.end()), begin_nm_(kernel.begin_nm), end_nm_(kernel.end_nm) {
    const int columns = static_cast<int>(std::bit_floor(static_cast<unsigned>(kernel.columns)));
    std::vector<LobeTable> tables(lights_.size());
    parallel_for(lights_.size(), [&](std::size_t i) { tables[i] = make_lobe_table(kernel, lights_[i], columns); });
    // Stored as fp16: each layer is divided by its light's flux, and all by the largest component.
    std::vector<float> inverse_flux;
    float largest = 1e-30F;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const auto flux = static_cast<float>(glm::compMax(lights_[i].flux));
        inverse_flux.push_back(flux > 0.0F ? 1.0F / flux : 0.0F);
        for (const glm::vec3& value : tables[i].values)
            largest = std::max(largest, inverse_flux[i] * glm::compMax(glm::abs(value)));
    }
    texture_ = gpu::Texture({.kind = gpu::TextureKind::PlaneArray,
                             .format = gpu::Format::RGBA16F,
                             .width = columns,
                             .height = tables[0].rows,
                             .depth = static_cast<int>(tables.size())},
                            {.filter = gpu::Filter::Linear});
    for (std::size_t i = 0; i < tables.size(); ++i) {
        for (glm::vec3& value : tables[i].values) value *= inverse_flux[i] / largest;
        texture_.upload(std::span<const glm::vec3>(tables[i].values), {.layer = static_cast<int>(i)});
    }
    scale_ = largest;
}

void GpuLobes::bind(const gpu::Program& program, const KernelUniforms& kernel, double pitch_nm) const {
    texture_.bind(kLobeUnit);
    const double extent_nm = end_nm_ - begin_nm_;
    // Five deviations of the kernel's own smoothing.
    program.set("lobe_reach", kernel.reach + glm::vec2(0.0F, 5.0F * kernel.scale_bias.z));
    program.set("lobe_scale_bias", glm::vec3(glm::dvec3(pitch_nm / extent_nm, -begin_nm_ / extent_nm, double{scale_})));
}

namespace {

gpu::Texture layered_texture(int size, std::size_t layers, std::size_t levels) {
    return gpu::Texture({.kind = gpu::TextureKind::PlaneArray,
                         .format = gpu::Format::RGBA16F,
                         .width = size,
                         .height = size,
                         .depth = static_cast<int>(layers),
                         .levels = static_cast<int>(levels)},
                        gpu::Sampling{.filter = gpu::Filter::Trilinear});
}

/// `value(density)`: the value of a texel.
template <typename Picture, typename ValueOf>
void upload_layer(gpu::Texture& texture, const Picture& picture, std::size_t layer, const ValueOf& value) {
    for (std::size_t level = 0; level < picture.levels.size(); ++level) {
        std::vector<glm::vec3> texels;
        texels.reserve(picture.levels[level].density.size());
        for (const auto& density : picture.levels[level].density) texels.push_back(value(density));
        texture.upload(std::span<const glm::vec3>(texels),
                       {.level = static_cast<int>(level), .layer = static_cast<int>(layer)});
    }
}

float largest_flux(const lighting::KeyLight& light) {
    return std::max(static_cast<float>(glm::compMax(light.flux)), 1e-30F);
}

}  // namespace

GpuPattern::GpuPattern(const Material& material, const glm::dmat3& xyz_to_working)
    : grating_(material.grating), illuminant_(material.quality.illuminant), xyz_to_working_(xyz_to_working) {}

void GpuPattern::upload_colours(std::span<const glm::vec3> light_colours) const {
    if (!picture_) {
        picture_ = pattern_picture(grating_, colour::LightSpectra(illuminant_));
        largest_ = 1e-30F;
        const glm::mat3 to_working(xyz_to_working_);
        for (PatternPicture::Level& level : picture_->levels)
            for (glm::mat3& density : level.density) {
                density = to_working * density;
                for (int c = 0; c < 3; ++c) largest_ = std::max(largest_, glm::compMax(glm::abs(density[c])));
            }
    }
    colours_.assign(light_colours.begin(), light_colours.end());
    texture_.emplace(
        layered_texture(picture_->levels[0].size, std::max<std::size_t>(colours_.size(), 1), picture_->levels.size()));
    for (std::size_t i = 0; i < colours_.size(); ++i)
        upload_layer(*texture_, *picture_, i,
                     [&](const glm::mat3& density) { return density * colours_[i] / largest_; });
}

GpuPattern::Lobes GpuPattern::lobes_of(std::span<const lighting::KeyLight> key_lights) const {
    Lobes lobes{.lights{key_lights.begin(), key_lights.end()}, .texture = {}};
    const std::vector<LightPicture> pictures =
        key_light_pictures(grating_, colour::LightSpectra(illuminant_), lobes.lights, xyz_to_working_);
    // Stored as fp16: each layer is divided by its light's flux, and all by the largest component.
    float largest = 1e-30F;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        for (const LightPicture::Level& level : pictures[i].levels)
            for (const glm::vec3& density : level.density)
                largest = std::max(largest, glm::compMax(glm::abs(density)) / largest_flux(key_lights[i]));
    const LightPicture& first = pictures[0];
    lobes.texture = layered_texture(first.levels[0].size, pictures.size(), first.levels.size());
    for (std::size_t i = 0; i < pictures.size(); ++i)
        upload_layer(lobes.texture, pictures[i], i,
                     [&](const glm::vec3& density) { return density / (largest * largest_flux(key_lights[i])); });
    lobes.scale =
        glm::vec4(glm::dvec4(0.5 / first.half_width, first.texel_variance(), double{largest}, first.half_width));
    return lobes;
}

void GpuPattern::bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
                      std::span<const glm::vec3> light_colours) const {
    if (program.has_uniform("pattern_scale")) {
        if (!texture_ || !std::ranges::equal(colours_, light_colours)) upload_colours(light_colours);
        texture_->bind(kKernelUnit);
        // level = ½ log₂(variance) + bias
        const double bias = -0.5 * std::log2(picture_->texel_variance());
        program.set("pattern_scale",
                    glm::vec4(glm::dvec4(0.5 / picture_->half_width, bias, double{largest_}, picture_->half_width)));
    }
    if (program.has_uniform("pattern_lobe_scale") && !key_lights.empty()) {
        const Lobes& lobes = last_used(
            lobes_, [&](const Lobes& known) { return same_lobes(known.lights, key_lights); },
            [&] { return lobes_of(key_lights); });
        lobes.texture.bind(kLobeUnit);
        program.set("pattern_lobe_scale", lobes.scale);
    }
}

}  // namespace rowland::diffraction
