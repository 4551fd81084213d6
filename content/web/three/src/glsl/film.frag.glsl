// Inserted after three's <lights_physical_pars_fragment> and film_table.frag.glsl: the film's reflectance for three's
// Fresnel term, and what it transmits for the layer beneath. PHYSICS (4.2), (5.1) of modules/thin_film.
mat3x4 film_seen;      // M of the lobe that the view sees
vec3 film_transmitted;  // fraction of white light

// `roughness`: the material's.
void prepare_film(inout PhysicalMaterial material, float n_v, float roughness) {
    film_seen = film_lobe(n_v, material.iridescenceThickness, film_rough * roughness);
    vec3 reflected = vec3(film_seen[0].w, film_seen[1].w, film_seen[2].w);
    film_transmitted = clamp(1.0 - material.iridescence * reflected, 0.0, 1.0);
    material.diffuseContribution *= film_transmitted;
}

vec3 film_over(vec3 bare, vec3 film, PhysicalMaterial material) {
    return mix(bare, max(film, 0.0), material.iridescence);
}

// The material without a film, with a Fresnel term of `f0` to `f90`.
PhysicalMaterial without_film(PhysicalMaterial material, vec3 f0, float f90) {
    material.iridescence = 0.0;
    material.metalness = 0.0;  // whose colour is in f0
    material.specularColor = f0;
    material.specularColorBlended = f0;
    material.specularF90 = f90;
    return material;
}

void RE_Direct_Film(const in IncidentLight light, const in vec3 position, const in vec3 normal, const in vec3 view,
                    const in vec3 coat_normal, const in PhysicalMaterial material, inout ReflectedLight reflected) {
    RE_Direct_Physical(light, position, normal, view, coat_normal, without_film(material, vec3(0.0), 0.0), reflected);
    vec3 irradiance = saturate(dot(normal, light.direction)) * light.color;
    vec3 lobe = irradiance * BRDF_GGX(light.direction, view, normal, without_film(material, vec3(1.0), 1.0));
    float v_h = saturate(dot(view, normalize(light.direction + view)));
    vec3 film = (film_matrix(v_h, material.iridescenceThickness, 0.0) * lobe).rgb;
    vec3 bare = lobe * F_Schlick(material.specularColorBlended, material.specularF90, v_h);
    reflected.directSpecular += film_over(bare, film, material);
}

void RE_IndirectDiffuse_Film(const in vec3 irradiance, const in vec3 position, const in vec3 normal, const in vec3 view,
                             const in vec3 coat_normal, const in PhysicalMaterial material, inout ReflectedLight reflected) {
    RE_IndirectDiffuse_Physical(irradiance, position, normal, view, coat_normal, without_film(material, vec3(0.0), 0.0),
                                reflected);
}

void RE_IndirectSpecular_Film(const in vec3 radiance, const in vec3 irradiance, const in vec3 coat_radiance,
                              const in vec3 position, const in vec3 normal, const in vec3 view, const in vec3 coat_normal,
                              const in PhysicalMaterial material, inout ReflectedLight reflected) {
    RE_IndirectSpecular_Physical(vec3(0.0), irradiance, coat_radiance, position, normal, view, coat_normal,
                                 without_film(material, vec3(0.0), 0.0), reflected);
    vec2 dfg = texture2D(dfgLUT, vec2(material.roughness, saturate(dot(normal, view)))).rg;
    float albedo = film_rough > 0.0 ? dfg.x + dfg.y : 1.0;  // three's least roughness would darken a mirror
    vec3 film = (film_seen * radiance).rgb * albedo;
    vec3 bare = (material.specularColorBlended * dfg.x + material.specularF90 * dfg.y) * radiance;
    reflected.indirectSpecular += film_over(bare, film, material);
}

#undef RE_Direct
#undef RE_IndirectDiffuse
#undef RE_IndirectSpecular
#define RE_Direct RE_Direct_Film
#define RE_IndirectDiffuse RE_IndirectDiffuse_Film
#define RE_IndirectSpecular RE_IndirectSpecular_Film
