// tinyobjloader with doubles, in a namespace of its own: a program that links Shoal may use the library's
// floats. For the readers of OBJ alone; tiny_obj.cpp holds its code.
#pragma once

#define TINYOBJLOADER_USE_DOUBLE
#define tinyobj shoal_tinyobj
#include <tiny_obj_loader.h>
