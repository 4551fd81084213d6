// Key lights on a diffuse surface: twin of lighting::irradiance().
#include "engine/render/shaders/key_light_block.h"

// Mean of the clamped cosine over a lobe: s.n is taken as normally distributed. The normal distribution's share below z
// is Abramowitz & Stegun 7.1.26, to 1.5e-7.
float lobe_cosine(KeyLightEntry key, vec3 n) {
    float c = dot(key.direction.xyz, n);
    float mean = c * key.direction.w;
    float variance = c * c * key.irradiance.w + max(1.0 - c * c, 0.0) * key.spread.x;
    float deviation = sqrt(max(variance, 1e-12));
    float z = mean / deviation;
    float density = exp(-0.5 * z * z);
    float t = 1.0 / (1.0 + 0.3275911 * 0.70710678 * abs(z));
    float beyond = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
    float tail = 0.5 * density * beyond;
    float share = z > 0.0 ? 1.0 - tail : tail;
    return max(mean * share + deviation * 0.39894228 * density, 0.0);
}

// Irradiance from all key lights, working space.
vec3 key_irradiance(vec3 n) {
    vec3 sum = vec3(0.0);
    int count = int(key_light_count.x);
    for (int i = 0; i < count; ++i) sum += lobe_cosine(key_lights[i], n) * key_lights[i].irradiance.xyz;
    return sum;
}
