// The one place that includes an OpenGL header: GLEW 2.2, core profile, 3.3 is the floor.
#pragma once

#include <GL/glew.h>
