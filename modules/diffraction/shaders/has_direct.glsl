// Whether pixels are lit by lights of their own: points and spots always are, the probe's key lights and directional
// lights where the surface has SEPARATE_LIGHTS.
#if defined(SEPARATE_LIGHTS) || defined(PUNCTUAL_LIGHTS)
#define HAS_DIRECT
#endif
