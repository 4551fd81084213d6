#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/ecs/entity.h"

namespace rowland::ecs {

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
        ROWLAND_CHECK(locks_ == 0, "a component storage was changed while a view iterates over it; use ecs::Commands");
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

}  // namespace rowland::ecs
