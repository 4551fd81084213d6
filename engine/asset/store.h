#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "engine/asset/file_watch.h"
#include "engine/core/check.h"

namespace rowland::asset {

/// The part of an asset's slot that does not depend on its type.
class Slot {
 public:
    Slot(std::string asset_name, const std::type_info& asset_type) : name(std::move(asset_name)), type(asset_type) {}
    virtual ~Slot() = default;
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;

    /// Reloads the asset on another thread.
    virtual void start_loading() = 0;
    virtual bool loading() const = 0;
    virtual void wait() const = 0;
    /// Takes over the result of start_loading() if that has ended; true if the asset was replaced. A load that failed
    /// throws nothing here: the old asset stays, and `failure` says why.
    virtual bool adopt() = 0;

    const std::string name;
    const std::type_info& type;
    FileWatch watch;
    std::uint64_t version = 1;
    std::string failure;
};

/// Loads one asset and adds the files it reads, or fails to read, to `read_files`. Reloading runs it on another thread,
/// so it must not call OpenGL. It may throw anything.
template <typename T>
using Loader = std::function<T(std::vector<std::filesystem::path>& read_files)>;

template <typename T>
class TypedSlot final : public Slot {
 public:
    TypedSlot(std::string asset_name, Loader<T> loader)
        : Slot(std::move(asset_name), typeid(T)), loader_(std::move(loader)) {
        Attempt first = attempt();
        watch = std::move(first.watch);
        if (first.error) std::rethrow_exception(first.error);
        value_ = std::move(first.value);
    }

    const std::shared_ptr<const T>& value() const { return value_; }

    void start_loading() override {
        running_ = std::async(std::launch::async, [this] { return attempt(); });
    }
    bool loading() const override { return running_.valid(); }
    void wait() const override {
        if (running_.valid()) running_.wait();
    }
    bool adopt() override {
        if (!running_.valid() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
        Attempt loaded = running_.get();
        watch = std::move(loaded.watch);
        if (loaded.error) {
            failure = message(loaded.error);
            return false;
        }
        failure.clear();
        value_ = std::move(loaded.value);
        ++version;
        return true;
    }

 private:
    struct Attempt {
        std::shared_ptr<const T> value;
        FileWatch watch;
        std::exception_ptr error;
    };

    Attempt attempt() const {
        const auto started = std::filesystem::file_time_type::clock::now();
        std::vector<std::filesystem::path> files;
        Attempt result;
        try {
            result.value = std::make_shared<const T>(loader_(files));
        } catch (...) {
            result.error = std::current_exception();
            // The load may have failed before the loader named all files: those of the last load are watched further.
            files.insert(files.end(), watch.files().begin(), watch.files().end());
        }
        result.watch = FileWatch(std::move(files), started);
        return result;
    }

    static std::string message(const std::exception_ptr& error) {
        try {
            std::rethrow_exception(error);
        } catch (const std::exception& exception) {
            return exception.what();
        } catch (...) {
            return "unknown failure";
        }
    }

    Loader<T> loader_;
    std::shared_ptr<const T> value_;
    std::future<Attempt> running_;
};

/// A shared asset of a store; keeps it alive.
template <typename T>
class Handle {
 public:
    Handle() = default;
    explicit Handle(std::shared_ptr<TypedSlot<T>> slot) : slot_(std::move(slot)) {}

    const T& operator*() const { return *slot_->value(); }
    const T* operator->() const { return slot_->value().get(); }
    /// The current asset. What the pointer holds stays the same when the store replaces the asset.
    std::shared_ptr<const T> value() const { return slot_->value(); }
    /// Grows whenever the asset is replaced.
    std::uint64_t version() const { return slot_->version; }
    explicit operator bool() const { return slot_ != nullptr; }

 private:
    std::shared_ptr<TypedSlot<T>> slot_;
};

/// Holds assets while a handle on them exists, and reloads them when a file they were made from changes. A failed load
/// keeps the old asset. Used from one thread; reloading runs on others.
class Store {
 public:
    /// poll() looks at the files once per `interval`.
    explicit Store(std::chrono::milliseconds interval = std::chrono::milliseconds(50)) : interval_(interval) {}

    /// The asset called `name`, loaded now unless a handle on it exists. Throws what the loader throws. It is a logic
    /// error to load one name with two types.
    template <typename T>
    Handle<T> load(const std::string& name, Loader<T> loader) {
        if (const std::shared_ptr<Slot> present = find(name)) {
            ROWLAND_CHECK(present->type == typeid(T), "one asset's name with two types");
            return Handle<T>(std::static_pointer_cast<TypedSlot<T>>(present));
        }
        auto slot = std::make_shared<TypedSlot<T>>(name, std::move(loader));
        slots_.push_back(slot);
        return Handle<T>(std::move(slot));
    }

    /// Starts reloading what has changed and adopts what has been loaded; call it every frame. Returns whether an asset
    /// was replaced or a load failed.
    bool poll();
    void reload_all();
    /// Waits for all loading to end; the next poll() adopts the results.
    void wait() const;

    /// Assets that failed to reload, "name: why" each, until they succeed.
    std::vector<std::string> failures() const;

 private:
    std::shared_ptr<Slot> find(const std::string& name) const;
    std::vector<std::shared_ptr<Slot>> held() const;

    std::vector<std::weak_ptr<Slot>> slots_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::time_point last_look_ = {};
};

}  // namespace rowland::asset
