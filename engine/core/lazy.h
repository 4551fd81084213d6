#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace rowland {

/// A value that is computed when it is first asked for. Copies share it. Any thread may ask.
template <typename T>
class Lazy {
 public:
    Lazy(T value) : shared_(std::make_shared<Shared>()) {  // NOLINT(google-explicit-constructor): a T serves as one
        std::call_once(shared_->once, [&] { shared_->value = std::move(value); });
    }
    explicit Lazy(std::function<T()> compute) : shared_(std::make_shared<Shared>()) {
        shared_->compute = std::move(compute);
    }

    const T& operator*() const {
        std::call_once(shared_->once, [&] { shared_->value = shared_->compute(); });
        return *shared_->value;
    }
    const T* operator->() const { return &**this; }

    /// Not while another thread may compute it.
    bool is_computed() const { return shared_->value.has_value(); }

 private:
    struct Shared {
        std::once_flag once;
        std::function<T()> compute;
        std::optional<T> value;
    };
    std::shared_ptr<Shared> shared_;
};

}  // namespace rowland
