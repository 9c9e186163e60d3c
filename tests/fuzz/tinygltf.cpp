// tinygltf once more, from its header: the library of the system has no counters in its branches, so a fuzzer would be
// blind in it. Pictures are never decoded by us, and their decoder is left out here.

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
