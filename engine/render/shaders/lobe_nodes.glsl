// The four angles and look-ups that stand for a GGX lobe: engine/lighting/lobe_nodes.h.
TEXTURE_UNIT(21) uniform sampler2D lobe_nodes;

const float LOBE_OFFSET = 0.02;  // kLobeCosineOffset

// Of a lobe in the table.
vec2 lobe_position(float n_v, float roughness) {
    float least = sqrt(LOBE_OFFSET);
    float root = (sqrt(n_v + LOBE_OFFSET) - least) / (sqrt(1.0 + LOBE_OFFSET) - least);
    float column = 0.5 * (root + 1.0 - sqrt(max(1.0 - n_v, 0.0)));
    vec2 size = vec2(textureSize(lobe_nodes, 0)) * vec2(1.0, 0.25);
    return (vec2(column, sqrt(roughness)) * (size - 1.0) + 0.5) / (size * vec2(1.0, 4.0));
}

vec4 lobe_plane(vec2 position, float plane) { return textureLod(lobe_nodes, position + vec2(0.0, 0.25 * plane), 0.0); }

// Of the microfacets.
vec4 lobe_cosines(vec2 position, float n_v, float roughness) {
    vec4 roots = sqrt(n_v + LOBE_OFFSET) + roughness * roughness * lobe_plane(position, 0.0);
    return clamp(roots * roots - LOBE_OFFSET, 0.0, 1.0);
}

vec4 lobe_weights(vec2 position) { return lobe_plane(position, 1.0); }

// Light is looked up along mix(mirror's direction, normal, lean).
vec4 lobe_leans(vec2 position, float roughness) { return roughness * roughness * lobe_plane(position, 2.0); }

vec4 lobe_roughnesses(vec2 position, float roughness) { return min(roughness * lobe_plane(position, 3.0), 1.0); }
