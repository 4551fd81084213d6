#pragma once

#include <string>
#include <string_view>

namespace rowland::test {

/// How a texture unit takes 8 bits of a position between texels.
enum class Fraction { Rounded, Truncated };

/// A shader whose texture look-ups are filtered with fractions of 8 bits, as texture units do; llvmpipe's are floats.
/// Unchanged: other texts than GLSL 4.50, and what is filtered so already. Lines keep their numbers.
std::string with_eight_bit_filtering(std::string_view shader, bool is_fragment, Fraction fraction);

/// From now on all shaders are compiled so if the environment variable ROWLAND_TEST_FILTERING is "rounded" or
/// "truncated". Throws Error (input) for another value.
void filter_as_asked();

}  // namespace rowland::test
