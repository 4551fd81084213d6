#include "tests/benchmark/entity_benchmark.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/buffer.h"
#include "engine/scene/transform.h"

namespace rowland::benchmark {

namespace {

constexpr int kEntities = 10000;

struct Spin {
    float radians_per_frame;
};

double elapsed_ms(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void print_entity_times(int rounds) {
    ecs::World world;
    for (int i = 0; i < kEntities; ++i) {
        const ecs::Entity entity = world.create();
        world.add(entity, scene::Transform{.translation = {static_cast<float>(i), 0.0F, 0.0F}});
        world.add(entity, Spin{0.001F * static_cast<float>(i % 7)});
    }
    gpu::Buffer matrices(kEntities * sizeof(glm::mat4));
    std::vector<glm::mat4> staging(kEntities);
    double move_ms = std::numeric_limits<double>::infinity();
    double upload_ms = move_ms;
    for (int round = 0; round < rounds; ++round) {
        const auto start = std::chrono::steady_clock::now();
        world.view<scene::Transform, Spin>().each([](scene::Transform& transform, const Spin& spin) {
            transform.rotation =
                glm::angleAxis(spin.radians_per_frame, glm::vec3(0.0F, 1.0F, 0.0F)) * transform.rotation;
        });
        scene::update_world_matrices(world);
        move_ms = std::min(move_ms, elapsed_ms(start));

        const auto upload_start = std::chrono::steady_clock::now();
        std::size_t next = 0;
        world.view<scene::WorldMatrix>().each(
            [&](const scene::WorldMatrix& matrix) { staging[next++] = matrix.matrix; });
        matrices.update(std::as_bytes(std::span<const glm::mat4>(staging)));
        glFinish();
        upload_ms = std::min(upload_ms, elapsed_ms(upload_start));
    }
    std::printf("%d moving entities a frame: transforms %.2f ms, upload %.2f ms\n", kEntities, move_ms, upload_ms);
}

}  // namespace rowland::benchmark
