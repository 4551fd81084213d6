// What is drawn into half floats. Drivers may truncate, which loses light pass by pass.

// To the nearest of the half floats' normal numbers, ties to even.
vec4 rounded_to_half(vec4 value) {
    uvec4 bits = floatBitsToUint(value);
    return uintBitsToFloat((bits + 0xfffu + ((bits >> 13) & 1u)) & 0xffffe000u);
}
