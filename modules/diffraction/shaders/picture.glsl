// An image of the diffraction term from the current view, which includes a cover's transmittance of the view.
TEXTURE_UNIT(11) uniform sampler2D picture;  // XYZ times alpha; alpha: the known fraction
uniform vec2 picture_scale;                 // pixels to texture coordinates

vec3 diffracted_radiance(GrooveView view) {
    vec4 texel = texture(picture, gl_FragCoord.xy * picture_scale);
    float passed = max(cover_transmittance(view.direction.z), 1e-4);
    return texel.a > 0.0 ? mat3(xyz_to_working) * texel.rgb / (texel.a * passed) : vec3(0.0);
}
