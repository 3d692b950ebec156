// A molecule's colour by its speed (src/scene/color_scale.h).
#include "state/molecule.glsl"

#include "render/looks.glsl"

const int mostVerticesRead = 64;  // evenly chosen from those of a larger molecule

uniform vec4 scaleColors[mostColors];  // linear RGB
uniform int scaleLast;                 // of the colours in use
uniform vec2 scaleSpan;                // x the quantity of the first colour, y 1 / (last - first)
uniform int scaleVertices;             // of the molecule

vec3 scaleColor(int molecule)
{
    int stride = (scaleVertices + mostVerticesRead - 1) / mostVerticesRead;
    vec3 sum = vec3(0.0);
    int count = 0;
    for (int v = 0; v < scaleVertices; v += stride) {
        sum += vertexVelocity(molecule, v);
        ++count;
    }
    return colorOfQuantity(length(sum) / float(count), scaleColors, scaleLast, scaleSpan);
}
