#include "content/demo/pixel/reference_picture.h"

#include <algorithm>
#include <chrono>
#include <span>

#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/pixel/surface_point.h"
#include "engine/colour/illuminant.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

/// Everything that a reference picture depends on.
struct ReferenceInputs {
    scene::Camera camera;
    glm::ivec2 size{0};  ///< texels
    PixelProbe probe;
    std::vector<PlacedMesh> meshes;                      ///< all, since others may hide a grating
    std::vector<std::optional<PlacedGrating>> gratings;  ///< of each mesh, if it is one
    std::vector<std::shared_ptr<const diffraction::CookedMaterial>> materials;  ///< likewise

    bool equals(const ReferenceInputs& other) const {
        const auto same_mesh = [](const PlacedMesh& a, const PlacedMesh& b) {
            return a.mesh == b.mesh && a.to_world == b.to_world;
        };
        return camera.eye == other.camera.eye && camera.target == other.camera.target && camera.up == other.camera.up &&
               camera.vertical_field_of_view == other.camera.vertical_field_of_view && size == other.size &&
               probe == other.probe && materials == other.materials &&
               std::equal(meshes.begin(), meshes.end(), other.meshes.begin(), other.meshes.end(), same_mesh);
    }
};

namespace {

constexpr int kCoarsest = 8;       ///< step of the first pass, texels
constexpr std::size_t kBatch = 8;  ///< texels between two checks of the stop token
constexpr int kFramesToRest = 3;
constexpr std::chrono::milliseconds kBetweenPublications(50);

/// Fills the square of each coarse texel where no finer pass has computed one. `steps`: the step of the pass that
/// computed a texel; 0: none has.
std::vector<glm::vec4> filled_up(const std::vector<glm::vec4>& xyz, const std::vector<int>& steps, glm::ivec2 size) {
    std::vector<glm::vec4> texels = xyz;
    const auto at = [size](int row, int column) {
        return static_cast<std::size_t>(size.y - 1 - row) * static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(column);
    };
    for (int step = kCoarsest; step > 1; step /= 2)
        for (int row = 0; row < size.y; ++row)
            for (int column = 0; column < size.x; ++column) {
                const std::size_t source = at(row - row % step, column - column % step);
                if (steps[at(row, column)] == 0 && steps[source] >= step) texels[at(row, column)] = xyz[source];
            }
    return texels;
}

ReferenceInputs view_of(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                        const PixelProbe& probe) {
    ReferenceInputs view;
    view.camera = camera;
    view.size = (pixels + kReferenceTexelSide - 1) / kReferenceTexelSide;
    view.probe = probe;
    world.view<render::MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const render::MeshInstance& instance, const scene::WorldMatrix& matrix) {
            if (comparison.is_copy(entity)) return;
            view.meshes.push_back({instance.mesh, matrix.matrix});
            const auto* surface = world.find<diffraction::DiffractionSurface>(entity);
            const bool measured = surface != nullptr && !surface->grooves;
            view.gratings.push_back(measured ? std::optional(PlacedGrating{.mesh = instance.mesh,
                                                                           .to_world = matrix.matrix,
                                                                           .groove_rotation = surface->groove_rotation})
                                             : std::nullopt);
            view.materials.push_back(measured ? comparison.own(entity)->cooked() : nullptr);
        });
    return view;
}

using Columns = std::pair<int, int>;  ///< first and end
using Points = std::vector<std::optional<VisiblePoint>>;
using Publish = Computed<std::shared_ptr<const ReferenceInputs>, ReferenceTexels>::Publish;

/// A texel that shows a grating from its front.
struct Texel {
    std::size_t at;  ///< in ReferenceTexels::xyz
    diffraction::ShadingPoint frame;
};

/// The texels of one mesh in one pass, without those that coarser passes computed.
std::vector<Texel> texels_of_pass(const ReferenceInputs& view, const Points& points, int step, std::size_t mesh,
                                  const Columns& columns) {
    std::vector<Texel> texels;
    const auto width = static_cast<std::size_t>(view.size.x);
    for (int row = 0; row < view.size.y; row += step)
        for (int column = 0; column < view.size.x; column += step) {
            const bool beside = column < columns.first || column >= columns.second;
            const bool earlier = step < kCoarsest && row % (2 * step) == 0 && column % (2 * step) == 0;
            const auto x = static_cast<std::size_t>(column);
            const auto& seen = points[static_cast<std::size_t>(row) * width + x];
            if (beside || earlier || !seen || seen->mesh != mesh) continue;
            const auto frame = frame_at(*view.gratings[mesh], seen->hit, seen->point, view.camera.eye);
            if (frame) texels.push_back({static_cast<std::size_t>(view.size.y - 1 - row) * width + x, *frame});
        }
    return texels;
}

class ReferenceWork {
 public:
    ReferenceWork(const ReferenceInputs& view, const std::stop_token& stop, const Publish& publish)
        : view_(view),
          stop_(stop),
          publish_(publish),
          probe_(load_full_resolution_probe(view.probe.path, view.probe.mapping, view.probe.recipes)),
          points_(visible_points(view.camera, view.size, view.meshes)),
          xyz_(points_.size(), glm::vec4(0.0F)),
          steps_(points_.size(), 0),
          all_(static_cast<std::size_t>(
              std::ranges::count_if(points_, [&](const auto& seen) { return seen && view.gratings[seen->mesh]; }))) {}

    /// `line`: of the wipe, in texels from the left; what is right of it comes first.
    std::optional<ReferenceTexels> run(int line) {
        for (const Columns& columns : {Columns{line, view_.size.x}, Columns{0, line}})
            for (int step = kCoarsest; step >= 1; step /= 2)
                for (std::size_t mesh = 0; mesh < view_.meshes.size(); ++mesh)
                    if (view_.gratings[mesh] && !pass(step, mesh, columns)) return std::nullopt;
        return ReferenceTexels{.xyz = filled_up(xyz_, steps_, view_.size), .done = 1, .all = 1};
    }

 private:
    /// False if it was stopped.
    bool pass(int step, std::size_t mesh, const Columns& columns) {
        const diffraction::Material& material = view_.materials[mesh]->material;
        const colour::LightSpectra spectra(material.quality.illuminant);
        const std::vector<Texel> texels = texels_of_pass(view_, points_, step, mesh, columns);
        for (std::size_t begin = 0; begin < texels.size(); begin += kBatch) {
            if (stop_.stop_requested()) return false;
            const std::size_t count = std::min(kBatch, texels.size() - begin);
            std::vector<diffraction::ShadingPoint> frames;
            for (std::size_t i = 0; i < count; ++i) frames.push_back(texels[begin + i].frame);
            const auto radiance = diffraction::reference_radiance(material.grating, probe_.image, spectra, frames);
            for (std::size_t i = 0; i < count; ++i) {
                xyz_[texels[begin + i].at] = glm::vec4(glm::vec3(radiance[i]), 1.0F);
                steps_[texels[begin + i].at] = step;
            }
            done_ += count;
            publish_sometimes();
        }
        return true;
    }

    void publish_sometimes() {
        const auto now = std::chrono::steady_clock::now();
        if (now - published_ < kBetweenPublications) return;
        published_ = now;
        publish_({.xyz = filled_up(xyz_, steps_, view_.size), .done = done_, .all = std::max<std::size_t>(all_, 1)});
    }

    const ReferenceInputs& view_;
    const std::stop_token& stop_;
    const Publish& publish_;
    FullResolutionProbe probe_;
    Points points_;
    std::vector<glm::vec4> xyz_;
    std::vector<int> steps_;  ///< as for filled_up()
    std::size_t all_;
    std::size_t done_ = 0;
    std::chrono::steady_clock::time_point published_;
};

}  // namespace

void ReferencePicture::update(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                              const PixelProbe& probe) {
    auto now = std::make_shared<const ReferenceInputs>(view_of(world, comparison, camera, pixels, probe));
    if (!view_ || !now->equals(*view_)) {
        stop(comparison);
        view_ = std::move(now);
    }
    frames_at_rest_ = std::min(frames_at_rest_ + 1, kFramesToRest);
    if (frames_at_rest_ < kFramesToRest) return;
    const int line = static_cast<int>(comparison.line() * static_cast<float>(view_->size.x));
    texels_.want(view_, [view = view_, line](const std::stop_token& token, const Publish& publish) {
        return ReferenceWork(*view, token, publish).run(line);
    });
    const auto change = texels_.poll();
    if (!change.failure.empty()) failure_ = change.failure;
    if (!change.value) return;
    if (!texture_)
        texture_ = std::make_shared<gpu::Texture>(
            gpu::TextureDesc{.format = gpu::Format::RGBA32F, .width = view_->size.x, .height = view_->size.y});
    texture_->upload(std::span<const glm::vec4>(texels_.value()->xyz));
    comparison.set_reference_picture(texture_);
}

void ReferencePicture::stop(Comparison& comparison) {
    texels_.reset();
    failure_.clear();
    view_.reset();
    frames_at_rest_ = 0;
    texture_.reset();
    comparison.set_reference_picture(nullptr);
}

double ReferencePicture::progress() const {
    const ReferenceTexels* texels = texels_.value();
    return texels == nullptr ? 0.0 : static_cast<double>(texels->done) / static_cast<double>(texels->all);
}

}  // namespace rowland::demo
