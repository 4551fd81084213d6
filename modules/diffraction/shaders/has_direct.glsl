// The analytic lights and the stage that shades them: points and spots at the pixels; under SEPARATE_LIGHTS the probe's
// key lights and directional lights at the pixels or, under LIGHTS_AT_VERTICES, at the vertices.
#if defined(PUNCTUAL_LIGHTS) || (defined(SEPARATE_LIGHTS) && !defined(LIGHTS_AT_VERTICES))
#define LIGHTS_AT_PIXELS
#endif
#if defined(SEPARATE_LIGHTS) || defined(PUNCTUAL_LIGHTS)
#define HAS_DIRECT
#endif
// Lights without extent.
#if (defined(SEPARATE_LIGHTS) && defined(DIRECTIONAL_LIGHTS)) || defined(PUNCTUAL_LIGHTS)
#define SMALL_LIGHTS
#endif
// A light that the vertices shade, with its shadow at the pixels.
#if defined(LIGHTS_AT_VERTICES) && defined(DIRECTIONAL_LIGHTS) && defined(SHADOWS)
#define SHADOWED_AT_PIXELS
#endif
// The vertices shade these lights and the pixels the rest. Where vertices shade everything, the sum is one output.
#if defined(LIGHTS_AT_VERTICES) && !defined(VERTEX_SHADED)
#define LIGHTS_BESIDE
#endif
// A streak shows the whole probe, key lights included. The incoherent rest of Stam's pits needs key lights.
#if defined(SEPARATE_LIGHTS) && !defined(NO_KEY_LIGHTS) && !(defined(STREAK) && defined(LOBE_GAUSSIAN))
#define KEY_LOBES
// One look-up per key light. The tables do not support order 0 or varying pitches. A program that defines
// KEY_LOBE_WINDOWS has no tables: key_lobe_windows.glsl.
#if !defined(ZERO_ORDER) && !defined(GROOVE_MAP) && !defined(KEY_LOBE_WINDOWS)
#define KEY_LOBE_TABLE
#endif
#endif
