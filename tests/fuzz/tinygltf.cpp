// tinygltf compiled from its header: the library of the system has no counters in its branches, which a fuzzer needs.
// Images are never decoded, and their decoder is left out here.

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
