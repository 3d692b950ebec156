#pragma once

namespace shoal {

// Tells which physics a group needs. Every pass, buffer and shader branch depends on one of these.
struct Needs {
    bool fields = false;  // there is a field and the group has drag
    bool drag = false;
    bool directionalDrag = false;
    bool gravity = false;
    bool forces = false;  // some accelerate by place: attract, vortexLine
    bool thrust = false;
    bool wind = false;  // a wind among the forces, and the group has drag
    bool springs = false;
    bool springDamping = false;
    bool actuation = false;
    bool pins = false;     // some vertex is held at the start
    bool release = false;  // and may be released
    bool records = false;  // anchors move or pins are released
    bool scale = false;    // instances differ from the molecule's own size
    bool phase = false;    // and in the phase of their muscles
    bool collide = false;
    bool normals = false;       // the shape has triangles
    bool life = false;          // some are born or die
    bool liveSprings = false;   // their numbers may change while it runs (CompileOptions)
    bool steers = false;        // they school
    bool avoids = false;        // and turn from colliders
    bool acceleration = false;  // the solver keeps the springs' acceleration
};

}  // namespace shoal
