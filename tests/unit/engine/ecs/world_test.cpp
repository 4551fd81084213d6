#include "engine/ecs/world.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>

namespace rowland::ecs {
namespace {

struct Position {
    float x = 0.0F;
};
struct Velocity {
    float x = 0.0F;
};
struct Frozen {};

TEST(World, StaleIdIsNotAliveAfterItsIndexIsReused) {
    World world;
    const Entity first = world.create();
    world.destroy(first);
    const Entity second = world.create();
    EXPECT_EQ(second.index, first.index);
    EXPECT_FALSE(world.alive(first));
    EXPECT_TRUE(world.alive(second));
    EXPECT_EQ(world.find<Position>(first), nullptr);
}

TEST(World, DestroyedIdIsDeadBeforeItsIndexIsReused) {
    World world;
    const Entity entity = world.create();
    world.destroy(entity);
    EXPECT_FALSE(world.alive(entity));
    EXPECT_FALSE(world.alive({entity.index, entity.version + 1}));
    EXPECT_FALSE(world.alive(Entity{}));
    EXPECT_EQ(world.living(), 0U);
}

TEST(World, RemovalKeepsTheOtherComponents) {
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 10; ++i) {
        entities.push_back(world.create());
        world.add(entities.back(), Position{static_cast<float>(i)});
    }
    world.remove<Position>(entities[3]);
    world.destroy(entities[7]);
    for (int i = 0; i < 10; ++i) {
        const Position* position = world.find<Position>(entities[static_cast<std::size_t>(i)]);
        if (i == 3 || i == 7) {
            EXPECT_EQ(position, nullptr);
        } else {
            ASSERT_NE(position, nullptr);
            EXPECT_EQ(position->x, static_cast<float>(i));
        }
    }
}

TEST(World, ViewVisitsExactlyTheEntitiesWithAllAndNoneExcluded) {
    World world;
    std::set<std::uint32_t> expected;
    for (int i = 0; i < 100; ++i) {
        const Entity entity = world.create();
        if (i % 2 == 0) world.add(entity, Position{});
        if (i % 3 == 0) world.add(entity, Velocity{1.0F});
        if (i % 5 == 0) world.add(entity, Frozen{});
        if (i % 6 == 0 && i % 5 != 0) expected.insert(entity.index);
    }
    std::set<std::uint32_t> visited;
    world.view<Position, Velocity>(Exclude<Frozen>{}).each([&](Entity entity, Position& position, Velocity& velocity) {
        position.x += velocity.x;
        EXPECT_TRUE(visited.insert(entity.index).second);
    });
    EXPECT_EQ(visited, expected);
    for (const std::uint32_t index : expected) EXPECT_EQ(world.get<Position>({index, 0}).x, 1.0F);
}

TEST(World, MatchesAMapUnderRandomChanges) {
    World world;
    std::map<std::uint32_t, std::pair<Entity, std::string>> truth;  // by index; "" = no component
    std::mt19937 random(7);
    const auto any = [&] {
        auto it = truth.begin();
        std::advance(it, static_cast<long>(random() % truth.size()));
        return it;
    };
    for (int step = 0; step < 20000; ++step) {
        const unsigned choice = random() % 4;
        if (choice == 0 || truth.empty()) {
            const Entity entity = world.create();
            truth[entity.index] = {entity, ""};
        } else if (choice == 1) {
            const auto it = any();
            it->second.second = std::to_string(step);
            world.add(it->second.first, it->second.second);
        } else if (choice == 2) {
            const auto it = any();
            it->second.second.clear();
            world.remove<std::string>(it->second.first);
        } else {
            const auto it = any();
            world.destroy(it->second.first);
            truth.erase(it);
        }
    }
    EXPECT_EQ(world.living(), truth.size());
    std::size_t with_component = 0;
    for (const auto& [index, entry] : truth) {
        const std::string* component = world.find<std::string>(entry.first);
        EXPECT_EQ(component ? *component : "", entry.second);
        with_component += component ? 1U : 0U;
    }
    EXPECT_EQ(world.view<std::string>().count(), with_component);
}

TEST(World, IndicesBeyondOnePageAreKeptApart) {
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 10000; ++i) entities.push_back(world.create());
    world.add(entities[1], Position{1.0F});
    world.add(entities[1 + 4096], Position{2.0F});
    EXPECT_EQ(world.get<Position>(entities[1]).x, 1.0F);
    EXPECT_EQ(world.get<Position>(entities[1 + 4096]).x, 2.0F);
    EXPECT_EQ(world.find<Position>(entities[1 + 8192]), nullptr);
}

TEST(WorldDeathTest, ChangingAnIteratedStorageIsAContractViolation) {
    World world;
    world.add(world.create(), Position{});
    const auto add_while_iterating = [&] {
        world.view<Position>().each([&](Entity, Position&) { world.add(world.create(), Position{}); });
    };
    const auto destroy_while_iterating = [&] {
        world.view<Position>().each([&](Entity entity, Position&) { world.destroy(entity); });
    };
    EXPECT_DEATH(add_while_iterating(), "while a view iterates");
    EXPECT_DEATH(destroy_while_iterating(), "while a view iterates");
}

TEST(WorldDeathTest, UsingADeadEntityIsAContractViolation) {
    World world;
    const Entity entity = world.create();
    world.destroy(entity);
    EXPECT_DEATH(world.add(entity, Position{}), "not alive");
    EXPECT_DEATH(world.destroy(entity), "not alive");
    EXPECT_DEATH(world.get<Position>(entity), "does not have");
}

TEST(World, OtherStoragesMayChangeDuringIteration) {
    World world;
    for (int i = 0; i < 5; ++i) world.add(world.create(), Position{});
    world.view<Position>().each([&](Entity entity, Position&) {
        world.add(entity, Velocity{});
        world.create();
    });
    EXPECT_EQ((world.view<Position, Velocity>().count()), 5U);
    EXPECT_EQ(world.living(), 10U);
}

}  // namespace
}  // namespace rowland::ecs
