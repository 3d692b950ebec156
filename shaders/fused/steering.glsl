// The steering of a molecule over a frame (shaders/school/steer.glsl), as three 4-vectors:
//   xyz acceleration of all of it, m/s^2          w  curvature that its muscles bend it to, 1/m
//   xyz acceleration of its turning, rad/s^2      w  rate of its muscles' clock
//   xyz steering as it was smoothed, m/s^2        w  its muscles' clock at the end of the frame, s
#ifdef STEERED
uniform VALUES steering;
uniform float givenSteeringEnd;  // s, of the frame that was steered, since the start of this one

vec3 steeringPush;
vec3 steeringSpin;
float curvature;
float clockRate;
float clockEnd;
float steeringEnd;

void loadSteering(int molecule)
{
    int first = firstElement(molecule, 3);
    vec4 push = element(steering, first, 0);
    vec4 spin = element(steering, first, 1);
    steeringPush = push.xyz;
    curvature = push.w;
    steeringSpin = spin.xyz;
    clockRate = spin.w;
    clockEnd = element(steering, first, 2).w;
    steeringEnd = inRegister(givenSteeringEnd);
}

// s; the molecule's own, in which its muscles move.
float swimClock(float time)
{
    return clockEnd - clockRate * (steeringEnd - time);
}

// m/s^2, at an arm from its middle.
vec3 steeringAt(vec3 arm)
{
    return steeringPush + cross(steeringSpin, arm);
}
#endif
