// A million entities: created, destroyed, visited and changed. "each" is the time for one entity.
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "tests/benchmark/microbenchmarks.h"

namespace rowland::microbenchmark {

namespace {

using ::benchmark::State;

constexpr std::size_t kEntities = 1'000'000;

template <int I>
struct Component {
    float value = 0.0F;
};

/// A world of entities that all have components 0 … N − 1.
template <int... I>
std::vector<ecs::Entity> fill(ecs::World& world, std::integer_sequence<int, I...>) {
    std::vector<ecs::Entity> entities(kEntities);
    for (ecs::Entity& entity : entities) {
        entity = world.create();
        (world.add(entity, Component<I>{1.0F}), ...);
    }
    return entities;
}

template <int N>
std::vector<ecs::Entity> fill(ecs::World& world) {
    return fill(world, std::make_integer_sequence<int, N>());
}

template <int N>
void create(State& state) {
    for (auto _ : state) {
        ecs::World world;
        ::benchmark::DoNotOptimize(fill<N>(world).data());
        state.PauseTiming();  // the world's destruction is not creation
        { const ecs::World destroyed = std::move(world); }
        state.ResumeTiming();
    }
    report_each(state, kEntities);
}

template <int N>
void destroy(State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        ecs::World world;
        const auto entities = fill<N>(world);
        state.ResumeTiming();
        for (const ecs::Entity entity : entities) world.destroy(entity);
    }
    report_each(state, kEntities);
}

template <int... I>
void visit(ecs::World& world, std::integer_sequence<int, I...>) {
    world.view<Component<I>...>().each([](auto&... component) { ((component.value += 1.0F), ...); });
}

template <int N>
void iterate(State& state) {
    ecs::World world;
    fill<N>(world);
    for (auto _ : state) {
        visit(world, std::make_integer_sequence<int, N>());
        ::benchmark::ClobberMemory();
    }
    report_each(state, kEntities);
}

/// Every other entity has the second component: the view skips from one to the next.
void iterate_half(State& state) {
    ecs::World world;
    const auto entities = fill<1>(world);
    for (std::size_t i = 0; i < kEntities; i += 2) world.add(entities[i], Component<1>{});
    for (auto _ : state) {
        visit(world, std::make_integer_sequence<int, 2>());
        ::benchmark::ClobberMemory();
    }
    report_each(state, kEntities / 2);
}

void add_and_remove(State& state) {
    ecs::World world;
    const auto entities = fill<1>(world);
    for (auto _ : state) {
        for (const ecs::Entity entity : entities) world.add(entity, Component<1>{1.0F});
        for (const ecs::Entity entity : entities) world.remove<Component<1>>(entity);
    }
    report_each(state, kEntities);
}

void add(const char* name, void (*function)(State&)) {
    ::benchmark::RegisterBenchmark(name, function)->Unit(::benchmark::kMillisecond);
}

}  // namespace

void register_entities() {
    add("ecs_create/components:0", create<0>);
    add("ecs_create/components:2", create<2>);
    add("ecs_destroy/components:0", destroy<0>);
    add("ecs_destroy/components:2", destroy<2>);
    add("ecs_iterate/components:1", iterate<1>);
    add("ecs_iterate/components:2", iterate<2>);
    add("ecs_iterate/components:2/half", iterate_half);
    add("ecs_iterate/components:7", iterate<7>);
    add("ecs_add_and_remove", add_and_remove);
}

}  // namespace rowland::microbenchmark
