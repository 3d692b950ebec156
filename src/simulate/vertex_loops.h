// Loops over the vertices of a lane in the fused shaders, written out before a driver sees them. In the files
// they are plain GLSL:
//
//     for (int i = 0; i < VERTICES; ++i) {        the body is short
//     for (int j = 0; j < VERTICES; ++j) {        the fields at a vertex: the body may be long
//     for (int k = 0; k < VERTICES; ++k) {        the contacts of a vertex: likewise
//     for (int n = 0; n < VERTICES; ++n) {        what touches several colliders: always long
//
// The body is repeated with 0, 1, … in place of the variable, so that every index is a constant and the
// arrays are registers; drivers unroll only what they think worth it.
#pragma once

#include "gpu/shader_source.h"

namespace shoal {

struct VertexLoops {
    enum class Form { keep, writeOut };
    int vertexCount = 0;
    Form shortBodies = Form::writeOut;  // over i
    Form fields = Form::keep;           // over j
    Form contacts = Form::keep;         // over k
    Form touches = Form::keep;          // over n
};

// Lines keep their origin, so that a driver's message still names our file and line.
void expand(gpu::ShaderSource& source, const VertexLoops& loops);

}  // namespace shoal
