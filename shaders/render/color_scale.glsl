// A molecule's colour by its speed (src/scene/color_scale.h). Needs state/molecule.glsl.

const int mostColors = 8;          // src/scene/color_scale.h
const int mostVerticesRead = 64;   // evenly chosen from those of a larger molecule

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
    float place = clamp((length(sum) / float(count) - scaleSpan.x) * scaleSpan.y, 0.0, 1.0) * float(scaleLast);
    int below = min(int(place), scaleLast - 1);
    return mix(scaleColors[below].rgb, scaleColors[below + 1].rgb, place - float(below));
}
