// The Fourier transform of LENGTH values in CHANNELS, by LENGTH / 2 invocations and in place [Cooley & Tukey 1965].
// forward() leaves frequency f at reversed(f), which is where inverse() takes it.

layout(local_size_x = LENGTH / 2) in;

layout(binding = 1) uniform sampler1D twiddles;

shared vec2 values[CHANNELS][LENGTH];

// Waits until all invocations of the group have written what others read next, and read what others overwrite.
void synchronize() {
    memoryBarrierShared();
    barrier();
}

uint reversed(uint index) {
    return bitfieldReverse(index) >> (32 - findMSB(uint(LENGTH)));
}

vec2 product(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The two values that an invocation combines in a step, and the factor of the second.
struct Butterfly {
    uint low;
    uint high;
    vec2 twiddle;
};

Butterfly butterfly(uint half_length) {
    uint offset = gl_LocalInvocationIndex & (half_length - 1);
    uint low = 2 * gl_LocalInvocationIndex - offset;
    vec2 twiddle = texelFetch(twiddles, int(offset * (LENGTH / 2 / half_length)), 0).xy;
    return Butterfly(low, low + half_length, twiddle);
}

void forward() {
    for (uint half_length = LENGTH / 2; half_length > 0; half_length >>= 1) {
        synchronize();
        Butterfly at = butterfly(half_length);
        for (int channel = 0; channel < CHANNELS; ++channel) {
            vec2 a = values[channel][at.low];
            vec2 b = values[channel][at.high];
            values[channel][at.low] = a + b;
            values[channel][at.high] = product(a - b, at.twiddle);
        }
    }
    synchronize();
}

// Not divided by LENGTH.
void inverse() {
    for (uint half_length = 1; half_length < LENGTH; half_length <<= 1) {
        synchronize();
        Butterfly at = butterfly(half_length);
        for (int channel = 0; channel < CHANNELS; ++channel) {
            vec2 a = values[channel][at.low];
            vec2 b = product(values[channel][at.high], vec2(at.twiddle.x, -at.twiddle.y));
            values[channel][at.low] = a + b;
            values[channel][at.high] = a - b;
        }
    }
    synchronize();
}
