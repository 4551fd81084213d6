// Inserted after three's <lights_physical_pars_fragment>: the diffraction term for MeshPhysicalMaterial.
#define eye cameraPosition
#include "content/web/three/src/glsl/grating.frag.glsl"

void RE_Direct_Grating(const in IncidentLight directLight, const in vec3 geometryPosition,
                       const in vec3 geometryNormal, const in vec3 geometryViewDir,
                       const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material,
                       inout ReflectedLight reflectedLight) {
    RE_Direct_Physical(directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material,
                       reflectedLight);
    add_lamp(inverseTransformDirection(directLight.direction, viewMatrix), directLight.color);
}
#undef RE_Direct
#define RE_Direct RE_Direct_Grating
