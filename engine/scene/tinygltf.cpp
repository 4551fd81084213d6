#define TINYGLTF_IMPLEMENTATION
#include "engine/scene/tinygltf.h"
