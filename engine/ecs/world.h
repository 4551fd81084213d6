#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/check.h"

namespace rowland::ecs {

/// A versioned id: the index is reused after destroy(), the version is not, so a stale id is never mistaken for a live
/// entity.
struct Entity {
    static constexpr std::uint32_t kNoIndex = 0xFFFFFFFFU;

    std::uint32_t index = kNoIndex;
    std::uint32_t version = 0;

    friend bool operator==(const Entity&, const Entity&) = default;
};

/// The entity side of a component storage: a paged sparse set. Dense order is insertion order, broken by swap-and-pop
/// on removal.
class SparseSet {
 public:
    virtual ~SparseSet() = default;
    SparseSet() = default;
    SparseSet(const SparseSet&) = delete;
    SparseSet& operator=(const SparseSet&) = delete;

    static constexpr std::uint32_t kAbsent = 0xFFFFFFFFU;

    std::size_t size() const { return dense_.size(); }
    const std::vector<Entity>& entities() const { return dense_; }
    bool contains(std::uint32_t entity_index) const { return slot(entity_index) != kAbsent; }
    /// Position in the dense array, or kAbsent.
    std::uint32_t slot(std::uint32_t entity_index) const {
        const std::size_t page = entity_index / kPageSize;
        if (page >= pages_.size() || !pages_[page]) return kAbsent;
        return (*pages_[page])[entity_index % kPageSize];
    }
    /// Removes the entity's component if it has one. Not while a view iterates over this storage.
    virtual void erase(std::uint32_t entity_index) = 0;

    /// While locked, adding to and removing from this storage is a contract violation. Views lock what they iterate.
    void lock() const { ++locks_; }
    void unlock() const { --locks_; }

 protected:
    void check_unlocked() const {
        ROWLAND_CHECK(locks_ == 0, "a component storage was changed while a view iterates over it");
    }
    void insert_entity(Entity entity) {
        const std::size_t page = entity.index / kPageSize;
        if (page >= pages_.size()) pages_.resize(page + 1);
        if (!pages_[page]) {
            pages_[page] = std::make_unique<Page>();
            pages_[page]->fill(kAbsent);
        }
        (*pages_[page])[entity.index % kPageSize] = static_cast<std::uint32_t>(dense_.size());
        dense_.push_back(entity);
    }
    /// Moves the last entity into `position`; the components must be moved likewise.
    void erase_entity(std::uint32_t entity_index, std::uint32_t position) {
        const Entity last = dense_.back();
        dense_[position] = last;
        (*pages_[last.index / kPageSize])[last.index % kPageSize] = position;
        (*pages_[entity_index / kPageSize])[entity_index % kPageSize] = kAbsent;
        dense_.pop_back();
    }

 private:
    static constexpr std::size_t kPageSize = 4096;
    using Page = std::array<std::uint32_t, kPageSize>;

    std::vector<std::unique_ptr<Page>> pages_;
    std::vector<Entity> dense_;
    mutable int locks_ = 0;
};

/// Contiguous storage of one component type.
template <typename T>
class Pool final : public SparseSet {
 public:
    T& insert_or_replace(Entity entity, T component) {
        const std::uint32_t position = slot(entity.index);
        if (position != kAbsent) return components_[position] = std::move(component);
        check_unlocked();
        insert_entity(entity);
        return components_.emplace_back(std::move(component));
    }
    void erase(std::uint32_t entity_index) override {
        const std::uint32_t position = slot(entity_index);
        if (position == kAbsent) return;
        check_unlocked();
        if (position + 1 != components_.size()) components_[position] = std::move(components_.back());
        components_.pop_back();
        erase_entity(entity_index, position);
    }
    T& at_slot(std::uint32_t position) { return components_[position]; }
    T* find(std::uint32_t entity_index) {
        const std::uint32_t position = slot(entity_index);
        return position == kAbsent ? nullptr : &components_[position];
    }

 private:
    std::vector<T> components_;
};

/// Components an entity must not have to be in a view.
template <typename... X>
struct Exclude {};

namespace detail {
std::size_t next_component_id();

template <typename T>
std::size_t component_id() {
    static const std::size_t id = next_component_id();
    return id;
}
}  // namespace detail

/// The entities that have all of T... and none of X... . Cheap to make; holds no entities itself.
/// Legal inside each(): reading and writing any component, replacing a component the entity already has, creating empty
/// entities, and changing storages the view does not iterate. Illegal, and asserted: adding or removing T...,
/// destroying an entity that has any of T... . Collect those, and do them afterwards.
template <typename Excluded, typename... T>
class View;

/// Entities and their components. One storage (paged sparse set, contiguous components) per component type.
/// A pointer or reference to a component is valid until that storage is next changed.
class World {
 public:
    Entity create();
    /// Removes all its components and retires the id. The entity must be alive.
    void destroy(Entity entity);
    bool alive(Entity entity) const {
        return entity.index < versions_.size() && versions_[entity.index] == entity.version && !retired_[entity.index];
    }
    std::size_t living() const { return versions_.size() - free_.size(); }

    /// Adds the component, or replaces the one the entity has.
    template <typename T>
    T& add(Entity entity, T component) {
        ROWLAND_CHECK(alive(entity), "add() on an entity that is not alive");
        return pool<T>().insert_or_replace(entity, std::move(component));
    }
    template <typename T>
    void remove(Entity entity) {
        ROWLAND_CHECK(alive(entity), "remove() on an entity that is not alive");
        pool<T>().erase(entity.index);
    }
    /// The component, or null if the entity is dead or has none.
    template <typename T>
    T* find(Entity entity) {
        return alive(entity) ? pool<T>().find(entity.index) : nullptr;
    }
    template <typename T>
    T& get(Entity entity) {
        T* component = find<T>(entity);
        ROWLAND_CHECK(component != nullptr, "get() of a component the entity does not have");
        return *component;
    }

    template <typename... T, typename... X>
    View<Exclude<X...>, T...> view(Exclude<X...> = {}) {
        return View<Exclude<X...>, T...>({&pool<T>()...}, {&pool<X>()...});
    }

 private:
    template <typename T>
    Pool<T>& pool() {
        const std::size_t id = detail::component_id<T>();
        if (id >= pools_.size()) pools_.resize(id + 1);
        if (!pools_[id]) pools_[id] = std::make_unique<Pool<T>>();
        return static_cast<Pool<T>&>(*pools_[id]);
    }

    std::vector<std::uint32_t> versions_;
    std::vector<bool> retired_;
    std::vector<std::uint32_t> free_;
    std::vector<std::unique_ptr<SparseSet>> pools_;
};

template <typename... X, typename... T>
class View<Exclude<X...>, T...> {
 public:
    View(std::tuple<Pool<T>*...> pools, std::tuple<Pool<X>*...> excluded) : pools_(pools), excluded_(excluded) {}

    /// Calls f(Entity, T&...) or f(T&...) for each entity of the view, in the dense order of its smallest storage.
    template <typename F>
    void each(F&& f) const {
        const Locks locks(pools_);
        const SparseSet& smallest = smallest_pool();
        for (std::size_t i = 0; i < smallest.size(); ++i) {
            const Entity entity = smallest.entities()[i];
            const auto slots =
                std::apply([&](auto*... pool) { return std::array{pool->slot(entity.index)...}; }, pools_);
            bool inside = true;
            for (const std::uint32_t slot : slots) inside = inside && slot != SparseSet::kAbsent;
            if (!inside || is_excluded(entity)) continue;
            call(f, entity, slots, std::index_sequence_for<T...>{});
        }
    }

    std::size_t count() const {
        std::size_t n = 0;
        each([&n](const T&...) { ++n; });
        return n;
    }

 private:
    /// Holds every storage of the view locked while it iterates.
    class Locks {
     public:
        explicit Locks(const std::tuple<Pool<T>*...>& pools) : pools_(pools) {
            std::apply([](auto*... pool) { (pool->lock(), ...); }, pools_);
        }
        ~Locks() {
            std::apply([](auto*... pool) { (pool->unlock(), ...); }, pools_);
        }
        Locks(const Locks&) = delete;
        Locks& operator=(const Locks&) = delete;

     private:
        const std::tuple<Pool<T>*...>& pools_;
    };

    const SparseSet& smallest_pool() const {
        const SparseSet* smallest = nullptr;
        const auto consider = [&smallest](const SparseSet* pool) {
            if (smallest == nullptr || pool->size() < smallest->size()) smallest = pool;
        };
        std::apply([&](auto*... pool) { (consider(pool), ...); }, pools_);
        return *smallest;
    }
    bool is_excluded(Entity entity) const {
        return std::apply([&](auto*... pool) { return (pool->contains(entity.index) || ...); }, excluded_);
    }
    template <typename F, typename Slots, std::size_t... I>
    void call(F& f, Entity entity, const Slots& slots, std::index_sequence<I...>) const {
        if constexpr (std::is_invocable_v<F, Entity, T&...>)
            f(entity, std::get<I>(pools_)->at_slot(slots[I])...);
        else
            f(std::get<I>(pools_)->at_slot(slots[I])...);
    }

    std::tuple<Pool<T>*...> pools_;
    std::tuple<Pool<X>*...> excluded_;
};

}  // namespace rowland::ecs
