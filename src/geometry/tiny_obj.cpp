#define TINYOBJLOADER_IMPLEMENTATION
#include "geometry/tiny_obj.h"
