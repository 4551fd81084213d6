#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rowland::math {

/// The discrete Fourier transform X_k = Σ_j x_j e^(2πi jk/n) of kLanes sequences at once, in single precision, by
/// Stockham's method. Exchange the real and imaginary parts of input and output for the transform with the opposite
/// sign in the exponent, which is n times the inverse. The error is about 1e-7 of the root mean square.
class FourierTransform {
 public:
    static constexpr std::size_t kLanes = 4;

    /// `size`: a power of two.
    explicit FourierTransform(std::size_t size);

    std::size_t size() const { return size_; }

    /// Sequences as real and imaginary parts: element j of lane l at [kLanes · j + l].
    struct Parts {
        std::span<float> real;
        std::span<float> imaginary;
    };
    /// Transforms `data` in place. `work` has the same lengths and is overwritten.
    void operator()(Parts data, Parts work) const;

 private:
    std::size_t size_;
    std::vector<float> cosine_;  ///< of 2π j/size, j < size/2
    std::vector<float> sine_;
};

}  // namespace rowland::math
