#pragma once

// tinygltf in a namespace of its own: Draco's shared library exports another build of it under the same names. It
// parses and writes JSON only; files, pictures and Draco streams are read by our own checked readers.
#include <fstream>  // tiny_gltf.h uses it even with TINYGLTF_NO_FS

#define tinygltf rowland_tinygltf
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop
#undef tinygltf

namespace rowland::scene {
namespace gltf = rowland_tinygltf;
}
