#include "content/demo/pixel/reference_still.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <span>

#include "content/demo/pixel/surface_point.h"
#include "content/demo/pixel/whole_probe.h"
#include "engine/colour/light_spectra.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

constexpr int kCoarsest = 8;       ///< texels between those of the first pass
constexpr std::size_t kBatch = 8;  ///< texels between two checks of the stop token
constexpr int kFramesToRest = 3;

/// Fills the square of each coarse texel where no finer pass has computed one. `steps`: of the pass that each texel is
/// from, 0: none.
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

bool same(const scene::Camera& a, const scene::Camera& b) {
    return a.eye == b.eye && a.target == b.target && a.up == b.up &&
           a.vertical_field_of_view == b.vertical_field_of_view;
}

}  // namespace

/// Everything that a still depends on.
struct ReferenceStill::View {
    scene::Camera camera;
    glm::ivec2 size{0};  ///< texels
    PixelProbe probe;
    std::vector<PlacedMesh> meshes;                      ///< all, since others may hide a grating
    std::vector<std::optional<PlacedGrating>> gratings;  ///< of each mesh, if it is one
    std::vector<std::shared_ptr<const diffraction::CookedMaterial>> materials;  ///< likewise

    bool equals(const View& other) const {
        const auto same_mesh = [](const PlacedMesh& a, const PlacedMesh& b) {
            return a.mesh == b.mesh && a.to_world == b.to_world;
        };
        return same(camera, other.camera) && size == other.size && probe == other.probe &&
               materials == other.materials &&
               std::equal(meshes.begin(), meshes.end(), other.meshes.begin(), other.meshes.end(), same_mesh);
    }
};

/// The computation of a still. Its task writes it, and frames read it.
struct ReferenceStill::Job {
    std::shared_ptr<const View> view;
    int line = 0;  ///< of the wipe, in texels from the left
    std::atomic<std::size_t> done = 0;
    std::atomic<std::size_t> all = 1;
    std::mutex mutex;
    std::vector<glm::vec4> xyz;  ///< row by row from the bottom; alpha 1: known
    std::vector<int> step;       ///< of the pass that each known texel is from, 0: none

    /// False if it was stopped.
    bool compute(const std::stop_token& stop);

 private:
    using Points = std::vector<std::optional<VisiblePoint>>;
    /// A texel that shows a grating from its front.
    struct Texel {
        std::size_t at;  ///< in xyz
        diffraction::Frame frame;
    };
    struct Columns {
        int begin;
        int end;
    };
    std::vector<Texel> texels_of_pass(const Points& points, int pass_step, std::size_t mesh,
                                      const Columns& columns) const;
    bool compute_pass(const std::vector<Texel>& texels, int pass_step, const diffraction::Material& material,
                      const lighting::ProbeImage& probe, const std::stop_token& stop);
};

ReferenceStill::View ReferenceStill::view_of(ecs::World& world, Comparison& comparison, const scene::Camera& camera,
                                             glm::ivec2 pixels, const PixelProbe& probe) {
    View view;
    view.camera = camera;
    view.size = (pixels + kStillTexel - 1) / kStillTexel;
    view.probe = probe;
    world.view<render::MeshInstance, scene::WorldMatrix>().each(
        [&](ecs::Entity entity, const render::MeshInstance& instance, const scene::WorldMatrix& matrix) {
            if (comparison.is_copy(entity)) return;
            view.meshes.push_back({instance.mesh, matrix.matrix});
            const auto* surface = world.find<diffraction::DiffractionSurface>(entity);
            const bool known = surface != nullptr && !surface->grooves;
            view.gratings.push_back(known ? std::optional(PlacedGrating{.mesh = instance.mesh,
                                                                        .to_world = matrix.matrix,
                                                                        .groove_rotation = surface->groove_rotation})
                                          : std::nullopt);
            view.materials.push_back(known ? comparison.own(entity)->cooked() : nullptr);
        });
    return view;
}

void ReferenceStill::update(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                            const PixelProbe& probe) {
    auto now = std::make_shared<const View>(view_of(world, comparison, camera, pixels, probe));
    if (!view_ || !now->equals(*view_)) {
        stop(comparison);
        view_ = std::move(now);
    }
    if (++frames_at_rest_ == kFramesToRest) begin(comparison.line());
    if (job_) show(comparison);
    if (const auto outcome = task_.poll()) failure_ = outcome->failure;
}

void ReferenceStill::stop(Comparison& comparison) {
    task_.cancel();
    job_.reset();
    view_.reset();
    frames_at_rest_ = 0;
    shown_ = 0;
    still_.reset();
    comparison.set_still(nullptr);
}

double ReferenceStill::progress() const {
    return job_ ? static_cast<double>(job_->done) / static_cast<double>(job_->all) : 0.0;
}

void ReferenceStill::begin(float line) {
    failure_.clear();
    job_ = std::make_shared<Job>();
    job_->view = view_;
    job_->line = static_cast<int>(line * static_cast<float>(view_->size.x));
    task_.start([job = job_](const std::stop_token& stop) { return job->compute(stop); });
}

std::vector<ReferenceStill::Job::Texel> ReferenceStill::Job::texels_of_pass(const Points& points, int pass_step,
                                                                            std::size_t mesh,
                                                                            const Columns& columns) const {
    std::vector<Texel> texels;
    const auto width = static_cast<std::size_t>(view->size.x);
    for (int row = 0; row < view->size.y; row += pass_step)
        for (int column = 0; column < view->size.x; column += pass_step) {
            const bool beside = column < columns.begin || column >= columns.end;
            const bool earlier = pass_step < kCoarsest && row % (2 * pass_step) == 0 && column % (2 * pass_step) == 0;
            const auto x = static_cast<std::size_t>(column);
            const auto& seen = points[static_cast<std::size_t>(row) * width + x];
            if (beside || earlier || !seen || seen->mesh != mesh) continue;
            const auto frame = frame_at(*view->gratings[mesh], seen->hit, seen->point, view->camera.eye);
            if (frame) texels.push_back({static_cast<std::size_t>(view->size.y - 1 - row) * width + x, *frame});
        }
    return texels;
}

bool ReferenceStill::Job::compute_pass(const std::vector<Texel>& texels, int pass_step,
                                       const diffraction::Material& material, const lighting::ProbeImage& probe,
                                       const std::stop_token& stop) {
    const colour::LightSpectra spectra(material.quality.illuminant);
    for (std::size_t begin = 0; begin < texels.size(); begin += kBatch) {
        if (stop.stop_requested()) return false;
        const std::size_t count = std::min(kBatch, texels.size() - begin);
        std::vector<diffraction::Frame> frames;
        for (std::size_t i = 0; i < count; ++i) frames.push_back(texels[begin + i].frame);
        const auto radiance = diffraction::reference_radiance(material.grating, probe, spectra, frames);
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < count; ++i) {
            xyz[texels[begin + i].at] = glm::vec4(glm::vec3(radiance[i]), 1.0F);
            step[texels[begin + i].at] = pass_step;
        }
        done += count;
    }
    return true;
}

bool ReferenceStill::Job::compute(const std::stop_token& stop) {
    if (stop.stop_requested()) return false;
    const WholeProbe probe = load_whole_probe(view->probe.path, view->probe.mapping, view->probe.recipes);
    const Points points = visible_points(view->camera, view->size, view->meshes);
    {
        const std::lock_guard lock(mutex);
        xyz.assign(points.size(), glm::vec4(0.0F));
        step.assign(points.size(), 0);
    }
    const auto shows_grating = [&](const auto& seen) { return seen && view->gratings[seen->mesh]; };
    all = std::max<std::size_t>(static_cast<std::size_t>(std::ranges::count_if(points, shows_grating)), 1);
    for (const Columns columns : {Columns{line, view->size.x}, Columns{0, line}})
        for (int pass_step = kCoarsest; pass_step >= 1; pass_step /= 2)
            for (std::size_t mesh = 0; mesh < view->meshes.size(); ++mesh)
                if (view->gratings[mesh] && !compute_pass(texels_of_pass(points, pass_step, mesh, columns), pass_step,
                                                          view->materials[mesh]->material, probe.image, stop))
                    return false;
    done = all.load();
    return true;
}

void ReferenceStill::show(Comparison& comparison) {
    const std::size_t done = job_->done;
    if (done == shown_) return;
    shown_ = done;
    const glm::ivec2 size = job_->view->size;
    std::vector<glm::vec4> texels;
    {
        const std::lock_guard lock(job_->mutex);
        texels = filled_up(job_->xyz, job_->step, size);
    }
    if (!still_)
        still_ = std::make_shared<gpu::Texture>(
            gpu::TextureDesc{.format = gpu::Format::RGBA32F, .width = size.x, .height = size.y});
    still_->upload(std::span<const glm::vec4>(texels));
    comparison.set_still(still_);
}

}  // namespace rowland::demo
