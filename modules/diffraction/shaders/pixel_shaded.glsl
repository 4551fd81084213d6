// The end of fragment stages that shade pixels. Before it, the program defines
//   vec3 diffracted_radiance(GrooveView view);
// in the working space, of a view above the horizon.
MaterialTerms material_terms() {
    GrooveView view = groove_view();
    vec3 from_probe = vec3(0.0);
    if (view.direction.z > 0.0 && view.pitch > 0.0) {
#ifdef GROOVE_MAP
        int parts = groove_parts(view);
        vec3 diffracted = vec3(0.0);
        for (int part = 0; part < parts; ++part) {
            GrooveView one = groove_part(view, parts, part);
            if (one.pitch > 0.0) diffracted += one.coverage * (diffracted_radiance(one) + key_lights_at_pixel(one));
        }
        from_probe = diffracted / float(parts);
#else
        from_probe = diffracted_radiance(view) + key_lights_at_pixel(view);
#endif
    }
    prepare_lights(view);
    return surface_terms(ambient_visibility() * from_probe + lights_from_vertices());
}
