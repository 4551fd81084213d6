// Visibility from the depth of the picture: engine/render/ambient_occlusion.h. AMBIENT_OCCLUSION.
#ifdef AMBIENT_OCCLUSION
TEXTURE_UNIT(16) uniform sampler2D visibility_map;

vec2 screen_visibility;  // of ambient light, of the light that casts shadows

// From the four nearest texels of the smaller picture, those at the pixel's depth first.
void read_screen_visibility() {
    vec2 at = gl_FragCoord.xy * dome.zw * vec2(textureSize(visibility_map, 0)) - 0.5;
    ivec2 last = textureSize(visibility_map, 0) - 1;
    ivec2 corner = ivec2(floor(at));
    vec2 part = at - vec2(corner);
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        vec3 texel = texelFetch(visibility_map, clamp(corner + step, ivec2(0), last), 0).xyz;
        vec2 near = mix(1.0 - part, part, vec2(step));
        float weight = (near.x * near.y + 1e-3) / (1e-3 + abs(texel.z * gl_FragCoord.w - 1.0));
        sum += weight * texel.xy;
        weights += weight;
    }
    screen_visibility = sum / weights;
}

float ambient_visibility() { return screen_visibility.x; }
// Of what a lobe of this perceptual roughness reflects at this angle from the normal [Lagarde & de Rousiers 2014].
float reflection_visibility(float cosine, float roughness) {
    float visible = screen_visibility.x;
    return clamp(pow(cosine + visible, exp2(-16.0 * roughness - 1.0)) - 1.0 + visible, 0.0, 1.0);
}
float contact_visibility() { return screen_visibility.y; }
#else
void read_screen_visibility() {}
float ambient_visibility() { return 1.0; }
float reflection_visibility(float cosine, float roughness) { return 1.0; }
float contact_visibility() { return 1.0; }
#endif
